// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "compile/ir.h"
#include "compile/ir_builder.h"

namespace gmsim::compile::ir {

/// d op(a, b) / d operand for operations from numbers to numbers; `y` is the node itself. Empty
/// when the operation is none of these; zero where it is constant.
[[nodiscard]] std::optional<NodeId> scalar_derivative(const Graph& graph, Builder& make, NodeId y,
                                                      int operand);

}  // namespace gmsim::compile::ir
