// SPDX-License-Identifier: MIT
#include "gmap/orbit_walk.h"

#include <algorithm>

namespace gmsim::gmap {

std::vector<DartId> orbit_darts(const GMap& map, OrbitType type, DartId d) {
  std::vector<DartId> darts;
  for_each_dart(map, type, d, [&](DartId x) { darts.push_back(x); });
  std::sort(darts.begin(), darts.end());
  return darts;
}

DartId smallest_dart(const GMap& map, OrbitType type, DartId d) {
  DartId smallest = d;
  for_each_dart(map, type, d, [&](DartId x) { smallest = std::min(smallest, x); });
  return smallest;
}

bool same_orbit(const GMap& map, OrbitType type, DartId a, DartId b) {
  bool found = false;
  for_each_dart(map, type, a, [&](DartId x) { found = found || x == b; });
  return found;
}

std::vector<DartId> quotient(const GMap& map, OrbitType outer, OrbitType inner, DartId d) {
  return quotient(map, outer, d, [&](DartId x) { return smallest_dart(map, inner, x); });
}

std::vector<DartId> all_orbits(const GMap& map, OrbitType type) {
  const detail::OrbitLinks links(map, type);
  std::vector<bool> seen(map.dart_end(), false);
  std::vector<DartId> smallest, queue;
  for (std::uint32_t i = 0; i < map.dart_end(); ++i) {
    if (seen[i] || !map.alive(DartId{i})) continue;
    smallest.push_back(DartId{i});
    queue.assign(1, DartId{i});
    seen[i] = true;
    for (std::size_t next = 0; next < queue.size(); ++next) {
      for (int k = 0; k < links.count; ++k) {
        const DartId x = links.alpha[k][index(queue[next])];
        if (!seen[index(x)]) queue.push_back(x);
        seen[index(x)] = true;
      }
    }
  }
  return smallest;
}

std::optional<std::vector<DartId>> polygon(const GMap& map, DartId d) {
  std::vector<DartId> corners;
  DartId x = d;
  do {
    corners.push_back(x);
    const DartId other_end = map.alpha(0, x);
    if (other_end == x || map.is_free(1, other_end)) return std::nullopt;
    x = map.alpha(1, other_end);
  } while (x != d);
  return corners;
}

}  // namespace gmsim::gmap
