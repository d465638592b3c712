// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <random>
#include <utility>
#include <vector>

#include "gmap/gmap.h"

namespace gmsim::test {

/// A map of dimension 3 and the point of each of its darts.
struct SolidMap {
  gmap::GMap map{3};
  std::vector<std::uint32_t> dart_point;

  [[nodiscard]] std::array<double, 3> position(const std::vector<std::array<double, 3>>& points,
                                               gmap::DartId dart) const {
    return points[dart_point[gmap::index(dart)]];
  }
};

/// Adds a volume from its faces, whose corners turn the same way around; darts in order of faces.
inline void add_polyhedron(SolidMap& solid, const std::vector<std::vector<std::uint32_t>>& faces) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, gmap::DartId> edges;
  for (const auto& face : faces) {
    const auto count = static_cast<std::uint32_t>(face.size());
    const auto first = gmap::index(solid.map.add_darts(2 * count));
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t from = face[i], to = face[(i + 1) % count];
      const gmap::DartId a{first + 2 * i}, b{first + 2 * i + 1};
      solid.dart_point.insert(solid.dart_point.end(), {from, to});
      solid.map.link(0, a, b);
      solid.map.link(1, b, gmap::DartId{first + 2 * ((i + 1) % count)});
      const auto other = edges.find({to, from});
      if (other == edges.end()) {
        edges[{from, to}] = a;
        continue;
      }
      const gmap::DartId c = other->second;
      solid.map.link(2, a, solid.map.alpha(0, c));
      solid.map.link(2, b, c);
    }
  }
}

/// The same map under other dart ids.
inline SolidMap renumbered(const SolidMap& solid, std::mt19937& random) {
  const std::uint32_t count = solid.map.dart_end();
  std::vector<std::uint32_t> target(count);
  for (std::uint32_t i = 0; i < count; ++i) target[i] = i;
  std::shuffle(target.begin(), target.end(), random);
  SolidMap result;
  result.map.add_darts(count);
  result.dart_point.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    result.dart_point[target[i]] = solid.dart_point[i];
    for (int link = 0; link <= 3; ++link) {
      const std::uint32_t other = gmap::index(solid.map.alpha(link, gmap::DartId{i}));
      if (other > i) result.map.link(link, gmap::DartId{target[i]}, gmap::DartId{target[other]});
    }
  }
  return result;
}

}  // namespace gmsim::test
