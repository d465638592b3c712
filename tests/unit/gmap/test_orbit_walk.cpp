// SPDX-License-Identifier: MIT
#include "gmap/orbit_walk.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "support/mesh_groups.h"

using namespace gmsim;
using namespace gmsim::gmap;

TEST_CASE("orbits of a quad grid") {
  const MeshMap built = build_map(grid(3, 3, 1.0, 1.0, GridCells::Quads));
  const DartId inner = built.point_dart[5], corner = built.point_dart[0];
  CHECK(orbit_darts(built.map, OrbitType{1, 2}, inner).size() == 8);
  CHECK(orbit_darts(built.map, OrbitType{1, 2}, corner).size() == 2);
  CHECK(orbit_darts(built.map, OrbitType{0, 1}, inner).size() == 8);
  CHECK(orbit_darts(built.map, OrbitType{}, inner) == std::vector{inner});
  CHECK(smallest_dart(built.map, OrbitType{0, 1, 2}, inner) == DartId{0});
  CHECK(same_orbit(built.map, OrbitType{0, 1, 2}, inner, corner));
  CHECK_FALSE(same_orbit(built.map, OrbitType{1, 2}, inner, corner));
  CHECK(all_orbits(built.map, OrbitType{0, 2}).size() == 24);
}

TEST_CASE("orbits larger than the work space on the stack") {
  const MeshMap built = build_map(grid(20, 20, 1.0, 1.0, GridCells::Quads));
  CHECK(orbit_darts(built.map, OrbitType{0, 1, 2}, DartId{77}).size() == 3200);
}

TEST_CASE("a type that the map lacks is our mistake") {
  const MeshMap built = build_map(chain(2, 1.0));
  CHECK_THROWS_AS((void)orbit_darts(built.map, OrbitType{2}, DartId{0}), support::InternalError);
}

TEST_CASE("a quotient takes its darts from the outer orbit") {
  const MeshMap built = build_map(grid(2, 2, 1.0, 1.0, GridCells::Quads));
  const DartId middle = built.point_dart[4];
  const auto corners = quotient(built.map, OrbitType{1, 2}, OrbitType{1}, middle);
  CHECK(corners.size() == 4);
  const auto edges = quotient(built.map, OrbitType{1, 2}, OrbitType{0, 2}, middle);
  CHECK(edges.size() == 4);
  for (DartId d : edges) CHECK(built.dart_point[index(d)] == 4);
}

TEST_CASE("polygon goes round a face from any dart, in the direction of its 0-link") {
  const MeshMap built = build_map(tests::mixed_polygons());
  const auto hexagon = polygon(built.map, DartId{2});
  REQUIRE(hexagon);
  std::vector<std::uint32_t> points;
  for (DartId d : *hexagon) points.push_back(built.dart_point[index(d)]);
  CHECK(points == std::vector<std::uint32_t>{1, 2, 3, 4, 5, 0});
  const auto back = polygon(built.map, DartId{1});
  REQUIRE(back);
  CHECK(built.dart_point[index(back->at(1))] == 0);
}

TEST_CASE("an open face has no polygon") {
  GMap map = build_map(grid(1, 1, 1.0, 1.0, GridCells::Quads)).map;
  map.unlink(1, DartId{3});
  CHECK_FALSE(polygon(map, DartId{0}));
  CHECK_FALSE(polygon(map, DartId{5}));
}
