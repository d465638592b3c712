// SPDX-License-Identifier: MIT
#include "engine/force_ways.h"

#include <algorithm>
#include <optional>

namespace gmsim::engine {

namespace {

using compile::MatchPlan;
using types::OrbitType;

/// Collects darts by the ways from the hook.
class Darts {
 public:
  void add_link(const Way& way, std::int8_t dimension) {
    const auto known = std::find_if(darts_.begin(), darts_.end(),
                                    [&](const PatternDart& dart) { return dart.to_hook == way; });
    PatternDart& dart = known != darts_.end() ? *known : darts_.emplace_back(PatternDart{way, {}});
    dart.links.insert(dimension);
  }
  /// The darts of a path that starts at the end of `way`, which becomes the way to its end.
  void add_path(Way& way, const std::vector<std::int8_t>& path) {
    for (const std::int8_t dimension : path) {
      add_link(way, dimension);
      way.push_back(dimension);
      add_link(way, dimension);
    }
  }
  [[nodiscard]] std::vector<PatternDart>& all() { return darts_; }

 private:
  std::vector<PatternDart> darts_{PatternDart{}};
};

}  // namespace

std::vector<PatternDart> pattern_darts(const MatchPlan& plan) {
  std::vector<std::optional<Way>> to_node(plan.nodes.size());
  to_node[plan.hooks.front()] = Way{};
  Darts darts;
  std::vector<bool> done(plan.arcs.size(), false);
  for (bool grown = true; grown;) {
    grown = false;
    for (std::size_t k = 0; k < plan.arcs.size(); ++k) {
      const compile::PlanArc& arc = plan.arcs[k];
      if (done[k] || (!to_node[arc.from] && !to_node[arc.to])) continue;
      const bool forwards = to_node[arc.from].has_value();
      std::vector<std::int8_t> path = arc.dimensions;
      if (!forwards) std::reverse(path.begin(), path.end());
      Way way = *to_node[forwards ? arc.from : arc.to];
      darts.add_path(way, path);
      std::optional<Way>& node = to_node[forwards ? arc.to : arc.from];
      if (!node) node = way;
      done[k] = grown = true;
    }
  }
  for (PatternDart& dart : darts.all()) {
    std::reverse(dart.to_hook.begin(), dart.to_hook.end());  // links lead both ways
    // Labels speak of whole orbits.
    if (plan.positions > 0) dart.links = OrbitType::range(0, types::kMaxDimension);
  }
  std::sort(darts.all().begin(), darts.all().end(), [](const PatternDart& a, const PatternDart& b) {
    return a.to_hook < b.to_hook;
  });
  return std::move(darts.all());
}

gmap::DartId follow(const gmap::GMap& map, gmap::DartId dart, const Way& way) {
  for (const std::int8_t dimension : way) dart = map.alpha(dimension, dart);
  return dart;
}

}  // namespace gmsim::engine
