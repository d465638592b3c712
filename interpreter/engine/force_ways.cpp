// SPDX-License-Identifier: MIT
#include "engine/force_ways.h"

#include <algorithm>
#include <optional>

#include "support/sort_once.h"

namespace gmsim::engine {

namespace {

using compile::Column;

/// Adds the darts of a path that starts at the end of `from`; returns where it ends.
Way walk_on(const Way& from, const std::vector<std::int8_t>& path, std::vector<Way>& all) {
  Way way = from;
  for (const std::int8_t dimension : path) {
    way.push_back(dimension);
    all.push_back(way);
  }
  return way;
}

}  // namespace

std::vector<Way> ways_to_hook(const compile::MatchPlan& plan) {
  std::vector<std::optional<Way>> to_node(plan.nodes.size());
  to_node[plan.hooks.front()] = Way{};
  std::vector<Way> all{Way{}};
  std::vector<bool> done(plan.arcs.size(), false);
  for (bool grown = true; grown;) {
    grown = false;
    for (std::size_t k = 0; k < plan.arcs.size(); ++k) {
      const compile::PlanArc& arc = plan.arcs[k];
      if (done[k] || (!to_node[arc.from] && !to_node[arc.to])) continue;
      const bool forwards = to_node[arc.from].has_value();
      std::vector<std::int8_t> path = arc.dimensions;
      if (!forwards) std::reverse(path.begin(), path.end());
      const Way end = walk_on(*to_node[forwards ? arc.from : arc.to], path, all);
      std::optional<Way>& node = to_node[forwards ? arc.to : arc.from];
      if (!node) node = end;
      done[k] = grown = true;
    }
  }
  for (Way& way : all) std::reverse(way.begin(), way.end());  // links lead both ways
  support::sort_once(all);
  return all;
}

gmap::DartId follow(const gmap::GMap& map, gmap::DartId dart, const Way& way) {
  for (const std::int8_t dimension : way) dart = map.alpha(dimension, dart);
  return dart;
}

}  // namespace gmsim::engine
