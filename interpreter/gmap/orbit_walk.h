// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "gmap/gmap.h"

namespace gmsim::gmap {

/// Calls f(dart) for every dart of the orbit of `d`, each once, starting with d. Orbits of at most
/// two links (half-edge, 2D vertex, 2D face …) are paths or cycles and are walked along, without
/// any marks; larger ones breadth first. Cost: the darts of the orbit. `f` may change links that
/// are not of the type.
template <class Visitor>
void for_each_dart(const GMap& map, OrbitType type, DartId d, Visitor&& f);

/// The darts of an orbit, ascending.
[[nodiscard]] std::vector<DartId> orbit_darts(const GMap& map, OrbitType type, DartId d);
/// The smallest dart of the orbit.
[[nodiscard]] DartId smallest_dart(const GMap& map, OrbitType type, DartId d);
[[nodiscard]] bool same_orbit(const GMap& map, OrbitType type, DartId a, DartId b);
/// One dart for each `inner` orbit met by the `outer` orbit of d, ascending: the smallest of those
/// that are in both. The quotient `outer(d) / inner` of the language.
[[nodiscard]] std::vector<DartId> quotient(const GMap& map, OrbitType outer, OrbitType inner,
                                           DartId d);
/// The same, where `smallest(x)` is the smallest dart of the inner orbit of x.
template <class Smallest>
[[nodiscard]] std::vector<DartId> quotient(const GMap& map, OrbitType outer, DartId d,
                                           Smallest&& smallest);
/// One dart (the smallest) for each orbit of the map, ascending.
[[nodiscard]] std::vector<DartId> all_orbits(const GMap& map, OrbitType type);
/// d, d@0@1, d@0@1@0@1 …: the corners around a face in order; empty when the face is open.
[[nodiscard]] std::optional<std::vector<DartId>> polygon(const GMap& map, DartId d);

}  // namespace gmsim::gmap

#include "gmap/orbit_walk_impl.h"
