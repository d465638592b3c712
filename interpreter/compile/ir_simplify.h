// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "compile/ir.h"

namespace gmsim::compile::ir {

/// The simpler node that op(a, b, c) is equal to, if a rule finds one. A rule never changes a finite
/// value but for the sign of zero (which atan2 shows as a half turn one way or the other), as long
/// as no intermediate value leaves the range of normal numbers: constants are folded where every
/// machine rounds alike, neutral elements dropped, minus signs and powers of two moved outwards (so
/// that equal and opposite forces share one node), operands of commutative operations ordered, whole
/// powers written out.
///
/// Two things may turn what is not finite into zero: a product or quotient with a constant zero is
/// zero, and a product with `if m then x else 0` is `if m then x * y else 0`, so that what a branch
/// excludes (the derivative of sqrt at 0, say) does not come back as 0 times infinity.
[[nodiscard]] std::optional<NodeId> simplify(Graph& graph, Op op, NodeId a, NodeId b, NodeId c,
                                             std::uint32_t aux, Span span);

}  // namespace gmsim::compile::ir
