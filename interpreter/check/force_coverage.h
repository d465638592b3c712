// SPDX-License-Identifier: MIT
#pragma once

#include "check/checked_rule.h"
#include "check/item_context.h"

namespace gmsim::check {

/// Every position that the energy reads must belong to a vertex that a `force` line gives its
/// gradient to, else momentum would be lost. Reports those that cannot be seen to, and what an energy
/// cannot be differentiated through.
///
/// Darts are compared as words of links from the pattern's nodes: links that keep the vertex (all but
/// 0) do not matter at the end of a word, and arcs and paths of the pattern lead from node to node.
void check_force_coverage(const Interaction& interaction, ItemContext& context);

/// Forces cannot be computed from forces, not even through a derived value.
void check_forces_start_somewhere(const Interaction& interaction, ItemContext& context);

}  // namespace gmsim::check
