// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>

#include "compile/walked_orbits.h"
#include "gmap/orbit_walk.h"
#include "gmap/random_map.h"
#include "support/sort_once.h"

using namespace gmsim;
using types::DartId;
using types::OrbitType;

TEST_CASE("walked orbits know what walks of the map find, and depend on each dart once a type") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    const int dimension = 1 + static_cast<int>(seed % 3);
    const gmap::GMap map = gmap::random_map(dimension, 400, seed);
    compile::WalkedOrbits walked(map);
    const unsigned types = 1u << (dimension + 1);
    for (int match = 0; match < 3; ++match) {
      walked.start({});
      std::vector<DartId> expected;
      for (std::uint32_t i = 0; i < map.dart_end(); i += 7) {
        if (!map.alive(DartId{i})) continue;
        const OrbitType outer = OrbitType::from_bits((seed + i) % types);
        const OrbitType inner = OrbitType::from_bits((3 * seed + i / 7) % types);
        CHECK(walked.smallest(inner, DartId{i}) == gmap::smallest_dart(map, inner, DartId{i}));
        CHECK(walked.quotient(outer, inner, DartId{i}) ==
              gmap::quotient(map, outer, inner, DartId{i}));
        gmap::for_each_dart(map, outer, DartId{i}, [&](DartId d) {
          gmap::for_each_dart(map, inner, d, [&](DartId e) { expected.push_back(e); });
          expected.push_back(d);
        });
      }
      std::vector<compile::Dependence> found;
      walked.swap(found);
      std::vector<DartId> darts;
      for (const compile::Dependence& at : found) darts.push_back(at.dart);
      CHECK(darts.size() <= std::size_t{types} * map.dart_end());
      support::sort_once(darts);
      support::sort_once(expected);
      CHECK(darts == expected);
    }
  }
}
