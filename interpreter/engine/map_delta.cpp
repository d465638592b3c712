// SPDX-License-Identifier: MIT
#include "engine/map_delta.h"

#include <algorithm>

#include "gmap/orbit_walk.h"
#include "support/sort_once.h"

namespace gmsim::engine {
namespace {

using compile::Aspects;
using compile::Dependence;

void add_orbit(const gmap::GMap& map, OrbitType type, DartId dart, Aspects what,
               std::vector<Dependence>& darts) {
  if (!map.alive(dart)) return;
  gmap::for_each_dart(map, type, dart, [&](DartId d) { darts.push_back({d, what}); });
}

/// Orbits that were split off, made or merged, and those that lost a part.
void add_changed_orbits(const gmap::GMap& map, const OrbitEvents& events,
                        std::vector<Dependence>& darts) {
  const gmap::OrbitRepair& repair = events.repair;
  std::vector<Row> givers, takers;
  for (const gmap::OrbitChange& orbit : repair.orbits)
    for (const Row source : repair.sources_of(orbit))
      if (source != orbit.row) {
        givers.push_back(source);
        takers.push_back(orbit.row);
      }
  support::sort_once(givers);
  support::sort_once(takers);
  const auto among = [](const std::vector<Row>& rows, Row row) {
    return std::binary_search(rows.begin(), rows.end(), row);
  };
  for (const gmap::OrbitChange& orbit : repair.orbits) {
    const auto sources = repair.sources_of(orbit);
    Aspects what = compile::values_of(events.type);
    if (sources.size() != 1)  // darts of several orbits have come together, or new ones
      what = compile::kEverything;
    else if (among(takers, orbit.row))
      what |= compile::row_of(events.type);
    else if (!among(givers, orbit.row))
      continue;
    add_orbit(map, events.type, orbit.smallest, what, darts);
  }
}

}  // namespace

MapDelta map_delta(const State& state, const Effects& effects) {
  MapDelta delta;
  const Aspects relinked =
      compile::links(effects.changed_links) | compile::links_of_numbers(effects.changed_links);
  const bool preserved = effects.created_darts == 0;  // which ones are new is not known
  for (const DartId dart : effects.touched)
    delta.darts.push_back(
        {dart, preserved && state.map.alive(dart) ? relinked : compile::kEverything});
  for (const WrittenOrbit& orbit : effects.written)
    add_orbit(state.map, orbit.type, orbit.dart, compile::kEverything, delta.darts);
  for (const OrbitEvents& events : effects.orbits)
    add_changed_orbits(state.map, events, delta.darts);
  compile::merge_aspects(delta.darts, &Dependence::dart);
  const OrbitType vertex = OrbitType::cell(0, state.map.dimension());
  if (const gmap::OrbitRepair* repair = effects.find(vertex)) {
    for (const gmap::OrbitChange& change : repair->orbits) delta.vertices.push_back(change.row);
    delta.vertices.insert(delta.vertices.end(), repair->sources.begin(), repair->sources.end());
    delta.vertices.insert(delta.vertices.end(), repair->removed.begin(), repair->removed.end());
  }
  if (const gmap::OrbitIndex* vertices = state.store.find_index(vertex))
    for (const auto& [dart, what] : delta.darts)
      if (state.map.alive(dart)) delta.vertices.push_back(vertices->row(dart));
  support::sort_once(delta.vertices);
  return delta;
}

}  // namespace gmsim::engine
