// SPDX-License-Identifier: MIT
#include "engine/match_watch.h"

#include <algorithm>

#include "gmap/orbit_walk.h"
#include "support/sort_once.h"

namespace gmsim::engine {

MatchWatch::MatchWatch(const ForceContext& context, const compile::RootedPattern& pattern,
                       const compile::ItemBody& body)
    : context_(context), pattern_(pattern), body_(body), ways_(ways_to_hook(pattern.match)) {
  clear();
}

void MatchWatch::clear() {
  watch_.clear();
  complete_ = pattern_.match.predicates.empty();
}

void MatchWatch::add(const ForceMatch& match) {
  complete_ = complete_ && !match.roles.everywhere;
  if (!complete_) return;
  const gmap::GMap& map = context_.state.map;
  darts_ = match.roles.walked;
  const DartId hook = match.nodes[body_.hook];
  for (const Way& way : ways_) {
    DartId dart = hook;
    for (auto link = way.rbegin(); link != way.rend(); ++link) dart = map.alpha(*link, dart);
    darts_.push_back(dart);
  }
  const auto add_orbit = [&](OrbitType type, DartId dart) {
    gmap::for_each_dart(map, type, dart, [&](DartId d) { darts_.push_back(d); });
  };
  add_orbit(body_.orbit, hook);
  for (const compile::Role& role : match.roles.roles) {
    // All darts of an orbit with another row are changed. What the match knows itself may rest on any
    // of the links in an orbit.
    if (match.own.empty()) {
      darts_.push_back(role.dart);
    } else {
      add_orbit(role.type, role.dart);
    }
  }
  support::sort_once(darts_);
  for (const DartId dart : darts_) watch_.add(dart, match.key);
}

void MatchWatch::find_stale(std::span<const DartId> changed, std::vector<DartId>& keys,
                            std::vector<DartId>& hooks) const {
  const gmap::GMap& map = context_.state.map;
  for (const DartId dart : changed) {
    watch_.for_each(dart, [&](DartId key) { keys.push_back(key); });
    if (!map.alive(dart)) continue;
    for (const Way& way : ways_) hooks.push_back(follow(map, dart, way));
  }
  support::sort_once(keys);
}

}  // namespace gmsim::engine
