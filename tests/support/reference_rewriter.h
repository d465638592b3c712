// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "check/checked_rule.h"
#include "support/tiny_map.h"

/// Matching and rewriting by the definitions, row by row and without any plan: the oracle for the
/// checker, the matcher and the rewriter. Slow on purpose.
namespace gmsim::tests {

/// A match: darts[row][node] for the nodes of `left`; next[row][p] is the row that the generator
/// at label position p leads to.
struct ReferenceMatch {
  std::vector<std::vector<int>> darts;
  std::vector<std::vector<int>> next;
};

/// The only match of `left` with these darts for its hooks, if there is one.
[[nodiscard]] std::optional<ReferenceMatch> reference_match(
    const TinyMap& map, const check::Pattern& left, const std::vector<check::NodeIndex>& hooks,
    const std::vector<int>& hook_darts);

struct ReferenceRewrite {
  TinyMap map;
  std::vector<std::vector<int>> darts;  ///< [row][node of `right`]
};

/// Applies a rule at a match: cuts what `left` names, makes what `right` names, removes the darts
/// of removed nodes. The result may be no valid map (flaw() tells).
[[nodiscard]] ReferenceRewrite reference_rewrite(TinyMap map, const check::Rule& rule,
                                                 const ReferenceMatch& match);

/// The orbit of each living dart, named by its smallest dart; kNone for dead ones.
[[nodiscard]] std::vector<int> reference_orbits(const TinyMap& map, types::OrbitType type);

}  // namespace gmsim::tests
