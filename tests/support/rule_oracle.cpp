// SPDX-License-Identifier: MIT
#include "support/rule_oracle.h"

#include <map>
#include <set>

#include "support/rule_hosts.h"

namespace gmsim::tests {

using check::NodeIndex;
using check::Rule;

std::optional<Application> apply_in_host(const Rule& rule, Random& random) {
  std::optional<Host> host = host_of(rule, random);
  if (!host) return std::nullopt;
  std::optional<ReferenceMatch> match =
      reference_match(host->map, rule.left, rule.hooks, host->hook_darts);
  if (!match) return std::nullopt;
  ReferenceRewrite after = reference_rewrite(host->map, rule, *match);
  return Application{std::move(host->map), std::move(*match), std::move(after)};
}

std::optional<Application> apply_somewhere(const Rule& rule, const TinyMap& map, int attempts,
                                           Random& random) {
  for (int k = 0; k < attempts; ++k) {
    std::vector<int> hooks;
    for (std::size_t h = 0; h < rule.hooks.size(); ++h) hooks.push_back(below(random, map.size()));
    std::optional<ReferenceMatch> match = reference_match(map, rule.left, rule.hooks, hooks);
    if (!match) continue;
    ReferenceRewrite after = reference_rewrite(map, rule, *match);
    return Application{map, std::move(*match), std::move(after)};
  }
  return std::nullopt;
}

ValueFate value_fate(const Application& application, const Rule& rule, types::OrbitType type,
                     const std::vector<NodeIndex>& assigned) {
  const std::vector<int> old_orbit = reference_orbits(application.before, type);
  const std::vector<int> new_orbit = reference_orbits(application.after.map, type);
  ValueFate fate;
  std::map<int, std::set<NodeIndex>> writers;
  for (const std::vector<int>& row : application.after.darts)
    for (const NodeIndex node : assigned) writers[new_orbit[row[node]]].insert(node);
  for (const auto& [orbit, nodes] : writers) fate.assigned_apart |= nodes.size() < assigned.size();
  std::map<int, std::set<int>> sources;
  const TinyMap& after = application.after.map;
  for (int d = 0; d < after.size(); ++d) {
    if (after.dead[d]) continue;
    std::set<int>& from = sources[new_orbit[d]];
    if (d < application.before.size()) from.insert(old_orbit[d]);
  }
  for (const auto& [orbit, from] : sources) {
    if (writers.contains(orbit)) continue;
    fate.missing |= from.empty();
    fate.several |= from.size() > 1;
  }
  return fate;
}

}  // namespace gmsim::tests
