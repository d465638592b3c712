// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "compile/ir.h"

namespace gmsim::compile::ir {

/// The simpler node that op(a, b, c) is equal to, if a rule finds one. Rules never change a finite
/// value but for the sign of zero: constants are folded, neutral elements dropped, minus signs
/// moved outwards (so that equal and opposite forces share one node), operands of commutative
/// operations ordered. The one exception is a product with a constant zero, which is zero.
[[nodiscard]] std::optional<NodeId> simplify(Graph& graph, Op op, NodeId a, NodeId b, NodeId c,
                                             std::uint32_t aux, Span span);

}  // namespace gmsim::compile::ir
