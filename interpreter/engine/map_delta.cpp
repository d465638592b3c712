// SPDX-License-Identifier: MIT
#include "engine/map_delta.h"

#include <algorithm>

#include "gmap/orbit_walk.h"
#include "support/sort_once.h"

namespace gmsim::engine {
namespace {

void add_orbit(const gmap::GMap& map, OrbitType type, DartId dart, std::vector<DartId>& darts) {
  if (!map.alive(dart)) return;
  gmap::for_each_dart(map, type, dart, [&](DartId d) { darts.push_back(d); });
}

/// Orbits that were split off, made or merged, and those that lost a part.
void add_changed_orbits(const gmap::GMap& map, const OrbitEvents& events,
                        std::vector<DartId>& darts) {
  const gmap::OrbitRepair& repair = events.repair;
  std::vector<Row> givers;
  for (const gmap::OrbitChange& orbit : repair.orbits)
    for (const Row source : repair.sources_of(orbit))
      if (source != orbit.row) givers.push_back(source);
  support::sort_once(givers);
  for (const gmap::OrbitChange& orbit : repair.orbits) {
    const auto sources = repair.sources_of(orbit);
    const bool as_before = sources.size() == 1 && sources.front() == orbit.row &&
                           !std::binary_search(givers.begin(), givers.end(), orbit.row);
    if (!as_before) add_orbit(map, events.type, orbit.smallest, darts);
  }
}

}  // namespace

MapDelta map_delta(const State& state, const Effects& effects) {
  MapDelta delta;
  delta.darts = effects.touched;
  for (const WrittenOrbit& orbit : effects.written)
    add_orbit(state.map, orbit.type, orbit.dart, delta.darts);
  for (const OrbitEvents& events : effects.orbits)
    add_changed_orbits(state.map, events, delta.darts);
  support::sort_once(delta.darts);
  const OrbitType vertex = OrbitType::cell(0, state.map.dimension());
  if (const gmap::OrbitRepair* repair = effects.find(vertex)) {
    for (const gmap::OrbitChange& change : repair->orbits) delta.vertices.push_back(change.row);
    delta.vertices.insert(delta.vertices.end(), repair->sources.begin(), repair->sources.end());
    delta.vertices.insert(delta.vertices.end(), repair->removed.begin(), repair->removed.end());
  }
  if (const gmap::OrbitIndex* vertices = state.store.find_index(vertex))
    for (const DartId dart : delta.darts)
      if (state.map.alive(dart)) delta.vertices.push_back(vertices->row(dart));
  support::sort_once(delta.vertices);
  return delta;
}

}  // namespace gmsim::engine
