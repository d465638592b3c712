// SPDX-License-Identifier: MIT
// Slow and obvious versions of what the map does, and random changes, for property tests.
#pragma once

#include <map>
#include <random>
#include <set>
#include <vector>

#include "gmap/gmap.h"
#include "gmap/orbit_index.h"
#include "gmap/orbit_walk.h"

namespace gmsim::tests {

using gmap::GMap;
using gmap::OrbitType;
using gmap::Row;
using types::DartId;

/// Every orbit type of a map of some dimension.
inline std::vector<OrbitType> all_types(int dimension) {
  std::vector<OrbitType> types;
  for (unsigned bits = 0; bits < (1u << (dimension + 1)); ++bits) {
    types.push_back(OrbitType::from_bits(static_cast<std::uint8_t>(bits)));
  }
  return types;
}

/// The orbit by closure of a set.
inline std::set<DartId> naive_orbit(const GMap& map, OrbitType type, DartId d) {
  std::set<DartId> orbit{d};
  std::vector<DartId> todo{d};
  while (!todo.empty()) {
    const DartId x = todo.back();
    todo.pop_back();
    for (int i = 0; i <= map.dimension(); ++i) {
      if (type.contains(i) && orbit.insert(map.alpha(i, x)).second) todo.push_back(map.alpha(i, x));
    }
  }
  return orbit;
}

/// The orbits of a map in order of their smallest darts.
inline std::vector<std::set<DartId>> naive_orbits(const GMap& map, OrbitType type) {
  std::vector<std::set<DartId>> orbits;
  std::set<DartId> seen;
  for (std::uint32_t d = 0; d < map.dart_end(); ++d) {
    if (!map.alive(DartId{d}) || seen.contains(DartId{d})) continue;
    orbits.push_back(naive_orbit(map, type, DartId{d}));
    seen.insert(orbits.back().begin(), orbits.back().end());
  }
  return orbits;
}

/// Sews, unsews, adds and removes at random, always from one valid map to another.
class RandomChanges {
 public:
  RandomChanges(GMap& map, std::uint64_t seed) : map_(map), random_(seed) {}

  /// One change; the darts it touched are appended, some of them several times.
  void change(std::vector<DartId>& touched) {
    if (map_.dart_count() == 0) return add(touched);
    switch (random_() % 8) {
      case 0:
        return remove(touched);
      case 1:
        return add(touched);
      case 2:
      case 3:
        return map_.unsew(random_dimension(), random_dart(), &touched);
      default:
        return sew(touched);
    }
  }
  DartId random_dart() {
    DartId d{0};
    do d = DartId{static_cast<std::uint32_t>(random_() % map_.dart_end())};
    while (!map_.alive(d));
    return d;
  }

 private:
  int random_dimension() {
    return static_cast<int>(random_() % static_cast<unsigned>(map_.dimension() + 1));
  }
  void sew(std::vector<DartId>& touched) {
    const int i = random_dimension();
    for (int attempt = 0; attempt < 20; ++attempt) {
      if (map_.sew(i, random_dart(), random_dart(), &touched)) return;
    }
  }
  void add(std::vector<DartId>& touched) {
    const auto count = static_cast<std::uint32_t>(1 + random_() % 3);
    const DartId first = map_.add_darts(count);
    for (std::uint32_t k = 0; k < count; ++k) touched.push_back(DartId{types::index(first) + k});
  }
  void remove(std::vector<DartId>& touched) {
    const int n = map_.dimension();
    const auto cell = gmap::orbit_darts(map_, OrbitType::cell(n, n), random_dart());
    for (DartId d : cell) map_.unsew(n, d, &touched);
    map_.remove_darts(cell);
    touched.insert(touched.end(), cell.begin(), cell.end());
  }

  GMap& map_;
  std::mt19937_64 random_;
};

}  // namespace gmsim::tests
