// SPDX-License-Identifier: MIT
#include "engine/force_matches.h"

#include <algorithm>
#include <utility>

#include "engine/enumerate.h"
#include "gmap/orbit_walk.h"

namespace gmsim::engine {

ForceMatches::ForceMatches(const ForceContext& context, std::uint32_t number)
    : ForceMatches(context, context.pattern(number), context.world, context.body(number),
                   compile::wanted_forces(context.body(number), true), context.sources) {}

ForceMatches::ForceMatches(const ForceContext& context, const compile::RootedPattern& pattern,
                           const compile::World& world, const compile::ItemBody& body,
                           compile::Wanted wanted, const compile::ValueSources& sources)
    : context_(context),
      pattern_(pattern),
      shapes_(world, body, std::move(wanted), sources),
      matcher_(context.state),
      reader_(context.state) {}

std::optional<support::Diagnostic> ForceMatches::find_all(const Visit& visit) {
  const gmap::GMap& map = context_.state.map;
  std::vector<bool> seen(map.dart_end(), false);
  for (std::uint32_t i = 0; i < seen.size(); ++i) {
    if (seen[i] || !map.alive(DartId{i})) continue;
    orbit_.clear();
    gmap::for_each_dart(map, pattern_.orbit, DartId{i}, [&](DartId d) {
      seen[types::index(d)] = true;
      orbit_.push_back(d);
    });
    if (Diagnostic error = find_in_orbit(visit)) return error;
  }
  return std::nullopt;
}

std::optional<support::Diagnostic> ForceMatches::find_at(DartId dart, const Visit& visit) {
  orbit_.clear();
  gmap::for_each_dart(context_.state.map, pattern_.orbit, dart,
                      [&](DartId d) { orbit_.push_back(d); });
  return find_in_orbit(visit);
}

std::optional<support::Diagnostic> ForceMatches::find_in_orbit(const Visit& visit) {
  if (!carries(orbit_.front())) return std::nullopt;
  std::sort(orbit_.begin(), orbit_.end());
  DartId hook = gmap::kNoDart;
  if (Diagnostic error = choose_dart(hook)) return error;
  return hook == gmap::kNoDart ? std::nullopt : enter(visit);
}

bool ForceMatches::carries(DartId d) const {
  if (!pattern_.presence) return true;
  const gmap::EmbeddingStore& store = context_.state.store;
  if (!store.in_use(*pattern_.presence)) return false;
  const std::span<const double> mark = store.get(*pattern_.presence, d);
  return !mark.empty() && mark[0] != 0.0;
}

std::optional<support::Diagnostic> ForceMatches::choose_dart(DartId& chosen) {
  first_.resize(context_.state.map.dart_end(), false);
  const auto kept = std::find_if(orbit_.begin(), orbit_.end(),
                                 [&](DartId d) { return bool{first_[types::index(d)]}; });
  const bool decided = kept != orbit_.end();
  const std::span<const DartId> candidates =
      decided ? std::span<const DartId>(&*kept, 1) : std::span<const DartId>(orbit_);
  bool without_first = false;
  for (const DartId d : candidates) {
    frame_.reset(pattern_.frame_size);
    Diagnostic error;
    const Start start = start_at(matcher_, pattern_.match, decided ? nullptr : pattern_.first.get(),
                                 pattern_.first_dart, d, frame_, found_, error);
    if (error) return error;
    without_first = without_first || start == Start::NotFirst;
    if (start != Start::Yes) continue;
    if (pattern_.first != nullptr) first_[types::index(d)] = true;
    chosen = d;
    return std::nullopt;
  }
  if (!without_first) return std::nullopt;
  return no_first(pattern_.orbit, orbit_.front(), *pattern_.first);
}

std::optional<support::Diagnostic> ForceMatches::enter(const Visit& visit) {
  match_.key = orbit_.front();
  match_.nodes.clear();
  for (compile::Column c = 0; c < pattern_.match.nodes.size(); ++c)
    match_.nodes.push_back(found_.dart(0, c));
  const std::optional<std::uint32_t> shape = shapes_.classify(match_.nodes, match_.roles);
  if (pattern_.match.positions > 0)  // its labels compare these
    for (const DartId dart : found_.darts)
      match_.roles.walked.push_back({dart, compile::kEverything});
  if (!shape) {
    if (!shapes_.failure().not_here) return shapes_.failure().diagnostic;
    match_.roles.roles.clear();
    if (excluded_) excluded_(match_);
    return std::nullopt;
  }
  match_.shape = *shape;
  while (inputs_.size() < shapes_.size())
    inputs_.push_back(std::make_unique<ShapeInputs>(context_, shapes_[inputs_.size()]));
  match_.own.clear();
  if (Diagnostic error = inputs_[*shape]->read_own(reader_, match_.roles.roles, match_.own))
    return error;
  visit(match_);
  return std::nullopt;
}

}  // namespace gmsim::engine
