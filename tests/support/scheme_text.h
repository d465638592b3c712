// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "check/checked_rule.h"

/// Rules in one line, for tests: "a*<0> b<_> | a-2-b => a<0> | a-2-a". Nodes with their labels,
/// `*` marks a hook; after `|` the arcs. No `=>`: a rule without right. Spans point into the text.
namespace gmsim::tests {

/// Throws std::invalid_argument on text that is not of this form.
[[nodiscard]] check::Rule rule_from_text(std::string_view text, int dimension);
[[nodiscard]] std::string to_text(const check::Rule& rule);

/// Sets left_to_right and right_to_left by the names of the nodes.
void pair_nodes_by_name(check::Rule& rule);

}  // namespace gmsim::tests
