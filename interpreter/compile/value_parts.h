// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compile/ir.h"
#include "types/value_type.h"

namespace gmsim::compile {

/// How a value is taken apart into nodes of an ir::Graph: `count` nodes of one kind, each made of
/// `stride` doubles of the value. Vec2, Mat2 (row-major) and arrays become several nodes; Bool and
/// Int are Real. An eigenpair is no storable value: see eigenpair_parts.
struct ValueParts {
  ir::ValueKind kind = ir::ValueKind::Real;
  std::uint32_t count = 1;
  std::uint32_t stride = 1;
};
[[nodiscard]] ValueParts value_parts(const types::ValueType& type);

/// The node of a constant of one of the kinds Real, Vec3, Mat3, Sym3, given by its doubles.
[[nodiscard]] ir::NodeId constant_part(ir::Graph& graph, ir::ValueKind kind,
                                       std::span<const double> numbers);

}  // namespace gmsim::compile
