// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "gmap/cell_order.h"
#include "gmap/mesh_builders.h"
#include "gmap/orbit_index.h"
#include "gmap/validate.h"

using namespace gmsim;
using namespace gmsim::gmap;

namespace {

std::vector<std::uint32_t> shuffled_numbers(std::size_t count, std::mt19937& random) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0u);
  std::shuffle(numbers.begin(), numbers.end(), random);
  return numbers;
}

/// The same mesh with its points and cells in random order.
Mesh shuffled(const Mesh& mesh, std::mt19937& random) {
  Mesh result;
  result.dimension = mesh.dimension;
  const auto place = shuffled_numbers(mesh.points.size(), random);
  result.points.resize(mesh.points.size());
  for (std::size_t p = 0; p < place.size(); ++p) result.points[place[p]] = mesh.points[p];
  for (const std::uint32_t cell : shuffled_numbers(mesh.cell_count(), random)) {
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t point : mesh.corners(cell)) corners.push_back(place[point]);
    result.add_cell(mesh.kinds[cell], corners);
  }
  return result;
}

/// How far apart the rows of the two ends of an edge are, on average.
double mean_row_distance(const GMap& map) {
  const OrbitIndex vertices(map, OrbitType::cell(0, map.dimension()));
  double sum = 0;
  for (std::uint32_t d = 0; d < map.dart_end(); ++d)
    sum += std::abs(static_cast<double>(vertices.row(DartId{d})) -
                    static_cast<double>(vertices.row(map.alpha(0, DartId{d}))));
  return sum / map.dart_end();
}

}  // namespace

TEST_CASE("a mesh in random order is built about as compactly as a grid") {
  std::mt19937 random(7);
  for (const Mesh& mesh : {grid(90, 80, 1, 1, GridCells::Mix4),
                           box({18, 18, 18}, {1, 1, 1}, BoxElements::Hexes)}) {
    CHECK(cell_order(mesh).empty());
    const Mesh random_mesh = shuffled(mesh, random);
    const std::vector<std::uint32_t> order = cell_order(random_mesh);
    REQUIRE(order.size() == mesh.cell_count());
    const MeshMap built = build_map(random_mesh, order);
    CHECK(built.problems.empty());
    CHECK(validate(built.map).empty());
    const double of_grid = mean_row_distance(build_map(mesh).map);
    CHECK(mean_row_distance(build_map(random_mesh).map) > 5 * of_grid);
    CHECK(mean_row_distance(built.map) < 2 * of_grid);
  }
}

TEST_CASE("points and cells keep their numbers in another order") {
  std::mt19937 random(3);
  const Mesh mesh = shuffled(grid(70, 70, 1, 1, GridCells::Quads), random);
  const std::vector<std::uint32_t> order = cell_order(mesh);
  REQUIRE(!order.empty());
  const MeshMap built = build_map(mesh, order);
  for (std::uint32_t cell = 0; cell < order.size(); ++cell)
    for (std::uint32_t c = 0; c < 4; ++c) {  // a quad has darts 2c at its corners c
      const std::uint32_t dart = 8 * cell + 2 * c;
      REQUIRE(built.dart_cell[dart] == order[cell]);
      REQUIRE(built.dart_point[dart] == mesh.corners(order[cell])[c]);
    }
}

TEST_CASE("small meshes and broken ones keep their order") {
  std::mt19937 random(1);
  CHECK(cell_order(shuffled(grid(10, 10, 1, 1, GridCells::Quads), random)).empty());
  Mesh broken = shuffled(grid(70, 70, 1, 1, GridCells::Quads), random);
  broken.cell_points[5] = 1'000'000;
  CHECK(cell_order(broken).empty());
  broken = shuffled(grid(70, 70, 1, 1, GridCells::Quads), random);
  broken.points[9][1] = std::nan("");
  CHECK(cell_order(broken).empty());
}
