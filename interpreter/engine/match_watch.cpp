// SPDX-License-Identifier: MIT
#include "engine/match_watch.h"

#include "gmap/orbit_walk.h"

namespace gmsim::engine {

using compile::Aspects;
using compile::Dependence;

MatchWatch::MatchWatch(const ForceContext& context, const compile::RootedPattern& pattern,
                       const compile::ItemBody& body)
    : context_(context),
      body_(body),
      pattern_(pattern_darts(pattern.match)),
      simple_(pattern.match.predicates.empty()) {
  clear();
}

void MatchWatch::clear() {
  watch_.clear();
  complete_ = simple_;
}

void MatchWatch::add_orbit(types::OrbitType type, DartId dart, Aspects what) {
  gmap::for_each_dart(context_.state.map, type, dart,
                      [&](DartId d) { darts_.push_back({d, what}); });
}

void MatchWatch::add_pattern(const ForceMatch& match) {
  const gmap::GMap& map = context_.state.map;
  darts_.insert(darts_.end(), match.roles.walked.begin(), match.roles.walked.end());
  const DartId hook = match.nodes[body_.hook];
  for (const PatternDart& of : pattern_) {
    DartId dart = hook;
    for (auto link = of.to_hook.rbegin(); link != of.to_hook.rend(); ++link)
      dart = map.alpha(*link, dart);
    darts_.push_back({dart, compile::links(of.links) | compile::kLife});
  }
  add_orbit(body_.orbit, hook, compile::links_of_numbers(body_.orbit) | compile::kLife);
}

void MatchWatch::add(const ForceMatch& match, const ShapeInputs& inputs) {
  complete_ = complete_ && !match.roles.everywhere;
  if (!complete_) return;
  darts_.clear();
  add_pattern(match);
  const std::vector<compile::Role>& roles = match.roles.roles;
  for (const compile::Role& role : roles)
    darts_.push_back({role.dart, compile::row_of(role.type)});
  for (const std::uint32_t role : inputs.column_roles())
    darts_.push_back({roles[role].dart, compile::values_of(roles[role].type)});
  // What a match knows itself may rest on any of the links in an orbit, and on values below it.
  for (const std::uint32_t role : inputs.own_roles())
    add_orbit(roles[role].type, roles[role].dart,
              compile::links_of_numbers(roles[role].type) | compile::kAllValues);
  enter(match.key);
}

void MatchWatch::add_excluded(const ForceMatch& match) {
  complete_ = complete_ && !match.roles.everywhere;
  if (!complete_) return;
  darts_.clear();
  add_pattern(match);
  for (Dependence& at : darts_) at.what = compile::kEverything;
  enter(match.key);
}

void MatchWatch::enter(DartId key) {
  compile::merge_aspects(darts_, &Dependence::dart);
  for (const auto& [dart, what] : darts_) watch_.add(dart, {key, what});
}

void MatchWatch::find_stale(std::span<const Dependence> changed, std::vector<StaleMatch>& stale,
                            std::vector<DartId>& hooks, std::vector<DartId>& parts) {
  const gmap::GMap& map = context_.state.map;
  for (const auto& [dart, what] : changed) {
    for (const DartWatch::Entry& entry : watch_.at(dart))
      if ((entry.what & what) != 0) stale.push_back({entry.key, entry.what & what});
    if (!map.alive(dart)) continue;
    if ((what & compile::links(body_.orbit)) != 0) parts.push_back(dart);
    for (const PatternDart& of : pattern_)
      if (what == compile::kEverything || (what & compile::links(of.links)) != 0)
        hooks.push_back(follow(map, dart, of.to_hook));
  }
  compile::merge_aspects(stale, &StaleMatch::key);
}

}  // namespace gmsim::engine
