// SPDX-License-Identifier: MIT
#include "gmap/mesh_builders.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "gmap/orbit_index.h"

using namespace gmsim;
using namespace gmsim::gmap;

namespace {

using Point = std::array<double, 3>;

/// Number of cells of each dimension, from 0 to n.
std::vector<Row> cell_counts(const GMap& map) {
  std::vector<Row> counts;
  for (int i = 0; i <= map.dimension(); ++i) {
    counts.push_back(OrbitIndex(map, OrbitType::cell(i, map.dimension())).orbit_count());
  }
  return counts;
}

std::vector<Row> counts_of(const Mesh& mesh) {
  const MeshMap built = build_map(mesh);
  CHECK(built.problems.empty());
  CHECK(built.map.dart_count() > 0);
  return cell_counts(built.map);
}

std::vector<std::uint32_t> corners(const Mesh& mesh, std::size_t cell) {
  return {mesh.corners(cell).begin(), mesh.corners(cell).end()};
}

}  // namespace

TEST_CASE("grid points are numbered row by row, middle points after them") {
  const Mesh mesh = grid(3, 2, 6.0, 4.0, GridCells::Tri4);
  REQUIRE(mesh.points.size() == 12 + 6);
  CHECK(mesh.points[1 * 4 + 2] == Point{4, 2, 0});
  CHECK(mesh.points[12] == Point{1, 1, 0});
  CHECK(mesh.points[12 + 4] == Point{3, 3, 0});
}

TEST_CASE("patches follow each other along x, counterclockwise from the lower left") {
  const Mesh quads = grid(3, 2, 1.0, 1.0, GridCells::Quads);
  CHECK(corners(quads, 4) == std::vector<std::uint32_t>{5, 6, 10, 9});
  const Mesh triangles = grid(3, 2, 1.0, 1.0, GridCells::Triangles);
  CHECK(corners(triangles, 8) == std::vector<std::uint32_t>{5, 6, 10});
  CHECK(corners(triangles, 9) == std::vector<std::uint32_t>{5, 10, 9});
}

TEST_CASE("mixed grids split the patches with an odd sum of coordinates") {
  const Mesh mix2 = grid(2, 2, 1.0, 1.0, GridCells::Mix2);
  CHECK(mix2.cell_count() == 6);
  CHECK(corners(mix2, 0).size() == 4);
  CHECK(corners(mix2, 1).size() == 3);
  const Mesh mix4 = grid(2, 2, 1.0, 1.0, GridCells::Mix4);
  CHECK(mix4.cell_count() == 10);
  CHECK(mix4.points.size() == 11);
  CHECK(mix4.points[9] == Point{0.75, 0.25, 0});
  CHECK(corners(mix4, 1) == std::vector<std::uint32_t>{1, 2, 9});
}

TEST_CASE("cells of grids") {
  CHECK(counts_of(grid(10, 10, 1, 1, GridCells::Quads)) == std::vector<Row>{121, 220, 100});
  CHECK(counts_of(grid(10, 10, 1, 1, GridCells::Triangles)) == std::vector<Row>{121, 320, 200});
  CHECK(counts_of(grid(10, 10, 1, 1, GridCells::Tri4)) == std::vector<Row>{221, 620, 400});
  CHECK(counts_of(grid(10, 10, 1, 1, GridCells::Mix2)) == std::vector<Row>{121, 270, 150});
  CHECK(counts_of(grid(10, 10, 1, 1, GridCells::Mix4)) == std::vector<Row>{171, 420, 250});
  CHECK(build_map(grid(10, 10, 1, 1, GridCells::Quads)).map.dart_count() == 800);
}

TEST_CASE("cells of boxes: right counts, positive volumes, neighbours that fit") {
  // V - E + F - C = 1 for a ball.
  CHECK(counts_of(box({3, 2, 2}, {1, 1, 1}, BoxElements::Hexes)) ==
        std::vector<Row>{36, 75, 52, 12});
  for (auto elements : {BoxElements::Tets6, BoxElements::Tets5}) {
    const auto counts = counts_of(box({3, 2, 2}, {1, 2, 3}, elements));
    CHECK(counts[0] == 36);
    CHECK(counts[3] == (elements == BoxElements::Tets6 ? 72 : 60));
    CHECK(counts[0] - counts[1] + counts[2] - counts[3] == 1);
    // Border faces: two for each of the 2 (3 2 + 3 2 + 2 2) squares.
    CHECK(2 * counts[2] - 4 * counts[3] == 2 * 32);
  }
}

TEST_CASE("box points are numbered along x, then y, then z") {
  const Mesh mesh = box({1, 2, 3}, {1, 2, 3}, BoxElements::Hexes);
  CHECK(mesh.points[(2 * 3 + 1) * 2 + 1] == Point{1, 1, 2});
  CHECK(corners(mesh, 0) == std::vector<std::uint32_t>{0, 1, 3, 2, 6, 7, 9, 8});
}

TEST_CASE("six tetrahedra share the diagonal of their cell") {
  const Mesh mesh = box({1, 1, 1}, {1, 1, 1}, BoxElements::Tets6);
  for (std::size_t cell = 0; cell < 6; ++cell) {
    CHECK(std::ranges::count(corners(mesh, cell), 0u) == 1);
    CHECK(std::ranges::count(corners(mesh, cell), 7u) == 1);
  }
}

TEST_CASE("a chain") {
  const Mesh mesh = chain(4, 2.0);
  CHECK(mesh.points[3] == Point{1.5, 0, 0});
  CHECK(counts_of(mesh) == std::vector<Row>{5, 4});
}

TEST_CASE("builders refuse nothing and too much") {
  CHECK_THROWS_AS((void)grid(0, 3, 1, 1, GridCells::Quads), support::InternalError);
  CHECK_THROWS_AS((void)box({70000, 70000, 2}, {1, 1, 1}, BoxElements::Hexes),
                  support::InternalError);
}
