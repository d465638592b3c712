// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "compile/ir.h"
#include "compile/ir_builder.h"

namespace gmsim::compile::ir {

/// Operations that are constant for derivatives: barriers, and what gives masks.
[[nodiscard]] bool is_barrier(Op op);

/// d op(a, b) / d operand for operations from numbers to numbers; `y` is the node itself. Empty
/// when the operation is none of these; zero where it is constant.
[[nodiscard]] std::optional<NodeId> scalar_derivative(const Graph& graph, Builder& make, NodeId y,
                                                      int operand);

}  // namespace gmsim::compile::ir
