// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>

#include "gmap/mesh.h"
#include "gmap/orbit_index.h"
#include "gmap/orbit_walk.h"
#include "gmap/validate.h"
#include "support/mesh_groups.h"

using namespace gmsim;
using namespace gmsim::gmap;
using tests::polygon_mesh;

namespace {

int euler(const GMap& map) {
  int sum = 0;
  for (int i = 0; i <= map.dimension(); ++i) {
    const int count =
        static_cast<int>(OrbitIndex(map, OrbitType::cell(i, map.dimension())).orbit_count());
    sum += i % 2 == 0 ? count : -count;
  }
  return sum;
}

Mesh solid(Mesh::CellKind kind, std::vector<std::array<double, 3>> points) {
  Mesh mesh;
  mesh.dimension = 3;
  std::vector<std::uint32_t> corners;
  for (std::uint32_t p = 0; p < points.size(); ++p) corners.push_back(p);
  mesh.points = std::move(points);
  mesh.add_cell(kind, corners);
  return mesh;
}

const std::vector<std::array<double, 3>> kTetrahedron{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// The only message, which must be as fatal as said.
std::string only_problem(const MeshMap& built, bool fatal) {
  REQUIRE(built.problems.size() == 1);
  CHECK(built.problems[0].fatal == fatal);
  CHECK(built.failed() == fatal);
  CHECK((built.map.dart_count() == 0) == fatal);
  return built.problems[0].message;
}

std::uint32_t point_after(const MeshMap& built, std::uint32_t d, std::initializer_list<int> links) {
  DartId x{d};
  for (int i : links) x = built.map.alpha(i, x);
  return built.dart_point[index(x)];
}

}  // namespace

TEST_CASE("every dart knows its point and cell, every used point its smallest dart") {
  for (const auto& [name, mesh] : tests::mesh_groups()) {
    CAPTURE(name);
    const MeshMap built = build_map(mesh);
    CHECK_FALSE(built.failed());
    REQUIRE(built.dart_point.size() == built.map.dart_end());
    REQUIRE(built.dart_cell.size() == built.map.dart_end());
    const int n = mesh.dimension;
    for (std::uint32_t d = 0; d < built.map.dart_end(); ++d) {
      for (int i = 0; i <= n; ++i) {
        const std::uint32_t other = index(built.map.alpha(i, DartId{d}));
        if (i > 0) CHECK(built.dart_point[other] == built.dart_point[d]);
        if (i < n) CHECK(built.dart_cell[other] == built.dart_cell[d]);
      }
      CHECK(std::ranges::count(mesh.corners(built.dart_cell[d]), built.dart_point[d]) == 1);
    }
    CHECK(OrbitIndex(built.map, OrbitType::cell(n, n)).orbit_count() == mesh.cell_count());
    for (std::uint32_t p = 0; p < mesh.points.size(); ++p) {
      const auto first = std::ranges::find(built.dart_point, p) - built.dart_point.begin();
      CHECK(built.point_dart[p] == DartId{static_cast<std::uint32_t>(first)});
    }
  }
}

TEST_CASE("Euler characteristics") {
  CHECK(euler(build_map(tests::cube_surface()).map) == 2);
  CHECK(euler(build_map(tests::pillow()).map) == 2);
  CHECK(euler(build_map(tests::torus(5, 4)).map) == 0);
  CHECK(euler(build_map(tests::moebius_strip(6)).map) == 0);
  CHECK(euler(build_map(tests::mixed_polygons()).map) == 1);
  CHECK(euler(build_map(tests::mixed_solids()).map) == 1);
  CHECK(euler(build_map(tests::ring()).map) == 0);
}

TEST_CASE("a one-sided strip is no problem") {
  const MeshMap built = build_map(tests::moebius_strip(5));
  CHECK(built.problems.empty());
  std::uint32_t border = 0;
  for (DartId d : built.map.alphas(0)) border += built.map.is_free(2, d);
  CHECK(border == 20);
}

TEST_CASE("cells of mixed solids") {
  const MeshMap built = build_map(tests::mixed_solids());
  CHECK(built.problems.empty());
  CHECK(built.map.dart_count() == 48 + 32 + 36 + 24);
  std::uint32_t inside = 0;
  for (std::uint32_t d = 0; d < built.map.dart_end(); ++d)
    inside += !built.map.is_free(3, DartId{d});
  CHECK(inside == 2 * (8 + 8 + 6));
}

TEST_CASE("the first dart of a tetrahedron leads to its corners in order") {
  const MeshMap built = build_map(solid(Mesh::CellKind::Tetrahedron, kTetrahedron));
  CHECK(point_after(built, 0, {}) == 0);
  CHECK(point_after(built, 0, {0}) == 1);
  CHECK(point_after(built, 0, {1, 0}) == 2);
  CHECK(point_after(built, 0, {2, 1, 0}) == 3);
}

TEST_CASE("inverted solids are turned round and counted") {
  for (const auto& group : tests::mesh_groups()) {
    if (group.mesh.dimension != 3) continue;
    CAPTURE(group.name);
    Mesh inverted = group.mesh;
    for (auto& point : inverted.points) point[2] = -point[2];
    const MeshMap built = build_map(inverted), original = build_map(group.mesh);
    REQUIRE_FALSE(built.problems.empty());
    CHECK(built.problems[0].message.starts_with("solids of negative volume, turned round: 0, 1"));
    CHECK(euler(built.map) == euler(original.map));
    CHECK(validate(built.map).empty());
    CHECK(built.dart_point[0] == original.dart_point[0]);
  }
  Mesh liar = solid(Mesh::CellKind::Tetrahedron, kTetrahedron);
  std::swap(liar.cell_points[1], liar.cell_points[2]);
  const MeshMap built = build_map(liar);
  CHECK(point_after(built, 0, {0}) == 1);
  CHECK(point_after(built, 0, {1, 0}) == 2);
}

TEST_CASE("solids whose neighbours are inverted still fit together") {
  Mesh mesh = box({2, 2, 2}, {1, 1, 1}, BoxElements::Tets6);
  for (std::uint32_t cell = 0; cell < mesh.cell_count(); cell += 2) {
    std::swap(mesh.cell_points[4 * cell], mesh.cell_points[4 * cell + 1]);
  }
  const MeshMap built = build_map(mesh);
  CHECK(
      only_problem(built, false) ==
      "solids of negative volume, turned round: 0, 2, 4, 6, 8, 10, 12, 14, 16, 18, … (24 in all)");
  CHECK(euler(built.map) == 1);
}

TEST_CASE("unused points have no dart") {
  Mesh mesh = polygon_mesh({{0, 0, 0}, {9, 9, 9}, {1, 0, 0}, {0, 1, 0}}, {{0, 2, 3}});
  const MeshMap built = build_map(mesh);
  CHECK(only_problem(built, false) == "points used by no cell: 1");
  CHECK(built.point_dart[1] == types::kNoDart);
  CHECK(built.point_dart[2] == DartId{1});
}

TEST_CASE("pinched points and edges become several") {
  const auto triangles = build_map(polygon_mesh(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}));
  CHECK(only_problem(triangles, false) ==
        "pinched points, where the cells fall apart into several vertices: 0 (2 vertices)");
  CHECK(OrbitIndex(triangles.map, OrbitType{1, 2}).orbit_count() == 6);
  const auto tets = build_map(tests::pinched_tets());
  REQUIRE(tets.problems.size() == 2);
  CHECK(tets.problems[0].message ==
        "pinched points, where the cells fall apart into several vertices: 0 (3 vertices), "
        "1 (2 vertices)");
  CHECK(tets.problems[1].message ==
        "pinched edges, around which the solids fall apart into several edges: 0-1 (2 edges)");
  CHECK_FALSE(tets.failed());
}

TEST_CASE("facets of more than two cells are fatal") {
  const auto fan = polygon_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
                                {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  CHECK(only_problem(build_map(fan), true) ==
        "edges of more than two polygons: 0-1 (cells 0, 1, 2)");
  Mesh star = chain(2, 1.0);
  star.points.push_back({0, 1, 0});
  star.add_cell(Mesh::CellKind::Segment, {1, 3});
  CHECK(only_problem(build_map(star), true) ==
        "points where more than two segments meet: 1 (cells 0, 1, 2)");
  Mesh tets = solid(Mesh::CellKind::Tetrahedron, kTetrahedron);
  tets.points.insert(tets.points.end(), {{0, 0, 2}, {0, 0, 3}});
  tets.add_cell(Mesh::CellKind::Tetrahedron, {0, 1, 2, 4});
  tets.add_cell(Mesh::CellKind::Tetrahedron, {0, 1, 2, 5});
  CHECK(only_problem(build_map(tets), true) ==
        "faces of more than two solids: 0-1-2 (cells 0, 1, 2)");
}

TEST_CASE("faces with the same corners in another order are fatal") {
  Mesh mesh = gmap::box({1, 1, 2}, {1, 1, 1}, BoxElements::Hexes);
  std::swap(mesh.cell_points[4], mesh.cell_points[5]);
  const auto problems = build_map(mesh).problems;
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].fatal);
  CHECK(problems[0].message ==
        "faces whose two solids order the corners differently: 4-5-6-7 (cells 0, 1)");
}

TEST_CASE("degenerate cells are fatal") {
  const std::vector<std::array<double, 3>> line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  CHECK(only_problem(build_map(polygon_mesh(line, {{0, 1, 2, 3}, {0, 3, 0}})), true) ==
        "cells that repeat a point: 1 (point 0)");
  CHECK(only_problem(build_map(polygon_mesh({{0, 0, 0}, {.1, .1, .1}, {.3, .3, .3}}, {{0, 1, 2}})),
                     true) == "polygons without area: 0");
  CHECK(only_problem(build_map(solid(Mesh::CellKind::Tetrahedron,
                                     {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {.3, .3, 0}})),
                     true) == "solids without volume: 0");
  Mesh segment = chain(1, 0.0);
  CHECK(only_problem(build_map(segment), true) == "segments without length: 0");
}

TEST_CASE("thin but sound cells far from the origin are accepted") {
  const double far = 1e3, thin = 1e-6;
  const auto built = build_map(
      solid(Mesh::CellKind::Tetrahedron,
            {{far, far, far}, {far + 1, far, far}, {far, far + 1, far}, {far, far, far + thin}}));
  CHECK(built.problems.empty());
}

TEST_CASE("cells that do not fit the mesh are fatal") {
  CHECK(only_problem(build_map(polygon_mesh({{0, 0, 0}, {1, 0, 0}}, {{0, 1}})), true) ==
        "cells with a kind or number of corners that does not fit: 0 (2 corners)");
  CHECK(only_problem(
            build_map(polygon_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 1, 7}})),
            true) == "cells with a point number beyond the last point: 1 (point 7)");
  Mesh mesh = solid(Mesh::CellKind::Tetrahedron, kTetrahedron);
  mesh.points[2][1] = std::nan("");
  CHECK(only_problem(build_map(mesh), true) == "points with a coordinate that is not finite: 2");
}

TEST_CASE("a cut mesh stays cut: points that coincide are not joined") {
  Mesh mesh = polygon_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                           {{0, 1, 2}, {3, 4, 5}});
  const MeshMap built = build_map(mesh);
  CHECK(built.problems.empty());
  CHECK(OrbitIndex(built.map, OrbitType{0, 1, 2}).orbit_count() == 2);
}

TEST_CASE("an empty mesh gives an empty map") {
  Mesh mesh;
  mesh.dimension = 3;
  const MeshMap built = build_map(mesh);
  CHECK(built.problems.empty());
  CHECK(built.map.dimension() == 3);
  CHECK(built.map.dart_count() == 0);
}
