// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "check/checked_rule.h"
#include "support/reference_rewriter.h"
#include "support/tiny_map.h"

/// What a rule does to maps, found out by doing it.
namespace gmsim::tests {

/// A place where a rule was applied.
struct Application {
  TinyMap before;
  ReferenceMatch match;
  ReferenceRewrite after;
};

/// Applies the rule in a map completed at random around its left side; empty when no such map was
/// found.
[[nodiscard]] std::optional<Application> apply_in_host(const check::Rule& rule, Random& random);

/// Applies the rule at random hook darts of a map; empty when none of `attempts` matched.
[[nodiscard]] std::optional<Application> apply_somewhere(const check::Rule& rule,
                                                         const TinyMap& map, int attempts,
                                                         Random& random);

/// What becomes of the values of one orbit type at an application, where the rule gives `assigned`
/// nodes of `right` values of their own, all different.
struct ValueFate {
  bool missing = false;  ///< an orbit of created darts without an assigned node
  bool several = false;  ///< an orbit without an assigned node and with darts of several old ones
  bool assigned_apart = false;  ///< an orbit with one assigned node that lacks another
};
[[nodiscard]] ValueFate value_fate(const Application& application, const check::Rule& rule,
                                   types::OrbitType type,
                                   const std::vector<check::NodeIndex>& assigned);

}  // namespace gmsim::tests
