// SPDX-License-Identifier: MIT
#include "engine/match_set.h"

#include <algorithm>
#include <utility>

#include "gmap/orbit_walk.h"
#include "support/sort_once.h"

namespace gmsim::engine {

namespace {

constexpr std::uint32_t kFewVacant = 256;

}  // namespace

MatchSet::MatchSet(const ForceContext& context, const compile::RootedPattern& pattern,
                   const compile::World& world, const compile::ItemBody& body,
                   compile::Wanted wanted, const compile::ValueSources& sources)
    : context_(context),
      body_(body),
      finder_(context, pattern, world, body, std::move(wanted), sources),
      watch_(context, pattern, body) {
  finder_.on_excluded([this](const ForceMatch& match) { watch_.add_excluded(match); });
}

MatchSet::Diagnostic MatchSet::rebuild() {
  for (const auto& table : tables_) table->clear();
  watch_.clear();
  places_.assign(context_.state.map.dart_end(), {});
  if (Diagnostic error = finder_.find_all([&](const ForceMatch& match) { add(match); }))
    return error;
  watch_.pack();
  return std::nullopt;
}

void MatchSet::add(const ForceMatch& match) {
  while (tables_.size() < finder_.shapes().size()) add_shape(match);
  if (places_.size() <= types::index(match.key)) places_.resize(context_.state.map.dart_end());
  places_[types::index(match.key)] = {match.shape, tables_[match.shape]->add(match)};
  watch_.add(match, finder_.inputs(match.shape));
}

/// The first match of a shape says through how many atomic forces all of them go.
void MatchSet::add_shape(const ForceMatch& first) {
  const auto number = static_cast<std::uint32_t>(tables_.size());
  const compile::Shape& shape = finder_.shapes()[number];
  const ShapeInputs& inputs = finder_.inputs(number);
  tables_.push_back(std::make_unique<MatchTable>(MatchTable::Widths{
      .roles = static_cast<std::uint32_t>(shape.roles.size() + first.roles.atomic.size()),
      .nodes = static_cast<std::uint32_t>(body_.nodes.size()),
      .targets = static_cast<std::uint32_t>(shape.targets.size()),
      .own = inputs.own_widths()}));
  own_stay_ = own_stay_ && inputs.own_stay_in_orbits();
}

std::uint32_t MatchSet::match_count() const {
  std::uint32_t count = 0;
  for (const auto& table : tables_) count += table->count();
  return count;
}

// ---- repairs ------------------------------------------------------------------------------------

void MatchSet::find_stale(std::span<const compile::Dependence> changed, Stale& out) {
  out.matches.clear();
  out.hooks.clear();
  out.parts.clear();
  watch_.find_stale(changed, out.matches, out.hooks, out.parts);
}

MatchSet::Diagnostic MatchSet::read_again(Place place, compile::Aspects what, Reading& out) {
  const MatchTable& table = *tables_[place.shape];
  const std::uint8_t way = table.way(place.row);
  out.again = true;
  if ((what & compile::kShape) != 0 || way == compile::MatchRoles::kNoWay) return std::nullopt;
  const std::span<const DartId> nodes = table.nodes(place.row);
  if ((what & compile::links_of_numbers(body_.orbit)) != 0 &&
      gmap::smallest_dart(context_.state.map, body_.orbit, nodes[body_.hook]) !=
          table.key(place.row))
    return std::nullopt;
  if (!finder_.shapes().follow(way, nodes, roles_)) return std::nullopt;
  out.again = out.own_changed = false;
  out.moved.clear();
  for (std::uint32_t role = 0; role < roles_.size(); ++role)
    if (const Row before = table.rows(role)[place.row]; before != roles_[role].row)
      out.moved.push_back({role, before, roles_[role].row});
  const ShapeInputs& inputs = finder_.inputs(place.shape);
  out.own.clear();
  if (inputs.own_count() == 0) {
    // Values that merged matches have added up.
    out.own_changed = (what & compile::kAllValues) != 0;
    return std::nullopt;
  }
  out.own_changed = true;
  return finder_.read_own(place.shape, roles_, out.own);
}

void MatchSet::adopt(Place place, const Reading& reading) {
  MatchTable& table = *tables_[place.shape];
  for (const Reading::Moved& moved : reading.moved) table.set_row(place.row, moved.role, moved.to);
  if (!reading.own.empty()) table.set_own(place.row, reading.own);
}

void MatchSet::remove(DartId key, std::vector<DartId>& hooks) {
  const Place gone = std::exchange(places_[types::index(key)], Place{});
  hooks.push_back(key);
  hooks.push_back(tables_[gone.shape]->nodes(gone.row)[body_.hook]);
  tables_[gone.shape]->vacate(gone.row);
}

void MatchSet::to_orbits(std::vector<DartId>& darts) const {
  const gmap::GMap& map = context_.state.map;
  std::erase_if(darts, [&](DartId dart) { return !map.alive(dart); });
  support::sort_once(darts);
  for (DartId& dart : darts) dart = gmap::smallest_dart(map, body_.orbit, dart);
  support::sort_once(darts);
}

/// An orbit that has other darts than before but still its match needs none: the darts that it may
/// have won from another had no match before the hook, or one that has been taken out.
void MatchSet::list_orbits(Stale& stale) const {
  to_orbits(stale.parts);
  for (const DartId smallest : stale.parts)
    if (place(smallest).shape == kNowhere) stale.hooks.push_back(smallest);
  to_orbits(stale.hooks);
}

MatchSet::Diagnostic MatchSet::find_at(DartId dart, std::optional<DartId>& key) {
  key.reset();
  return finder_.find_at(dart, [&](const ForceMatch& match) {
    add(match);
    key = match.key;
  });
}

bool MatchSet::crowded() const {
  return std::any_of(tables_.begin(), tables_.end(), [](const auto& table) {
    return table->size() > table->count() + table->count() / 4 + kFewVacant;
  });
}

void MatchSet::pack() {
  std::vector<std::vector<std::uint32_t>> rows(tables_.size());
  for (Place& place : places_) {
    if (place.shape == kNowhere) continue;
    rows[place.shape].push_back(place.row);
    place.row = static_cast<std::uint32_t>(rows[place.shape].size()) - 1;
  }
  for (std::size_t shape = 0; shape < tables_.size(); ++shape) tables_[shape]->pack(rows[shape]);
}

}  // namespace gmsim::engine
