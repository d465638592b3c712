// SPDX-License-Identifier: MIT
#include "gmap/orbit_index.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "gmap/journal.h"
#include "gmap/orbit_walk.h"
#include "gmap/validate.h"
#include "support/map_oracle.h"
#include "support/mesh_groups.h"

using namespace gmsim;
using namespace gmsim::gmap;

namespace {

const OrbitType kVertex{1, 2};

}  // namespace

TEST_CASE("unsewing an inner edge of a grid splits nothing, the second one does") {
  GMap map = build_map(grid(2, 2, 1.0, 1.0, GridCells::Quads)).map;
  OrbitIndex vertices(map, kVertex);
  CHECK(vertices.orbit_count() == 9);
  std::vector<DartId> touched;
  OrbitRepair repair;
  map.unsew(2, DartId{2}, &touched);  // between the lower quads: one end on the border
  vertices.repair(map, touched, repair);
  CHECK(repair.orbits.size() == 3);
  CHECK(repair.split == 1);
  CHECK(vertices.orbit_count() == 10);
  CHECK(vertices.row_end() == 10);
  CHECK(repair.orbits[0].row == vertices.row(repair.orbits[0].smallest));
}

TEST_CASE("the part with the smallest dart keeps the row, the rest get new ones") {
  GMap map = build_map(grid(2, 1, 1.0, 1.0, GridCells::Quads)).map;
  OrbitIndex vertices(map, kVertex);
  const Row below = vertices.row(DartId{1}), above = vertices.row(DartId{3});
  std::vector<DartId> touched;
  OrbitRepair repair;
  map.unsew(2, DartId{2}, &touched);
  vertices.repair(map, touched, repair);
  CHECK(vertices.row(DartId{2}) == below);
  CHECK(vertices.row(DartId{3}) == above);
  CHECK(vertices.row(DartId{15}) == 6);
  CHECK(vertices.row(DartId{14}) == 7);
  for (const OrbitChange& change : repair.orbits) CHECK(change.sources_count == 1);
  // Sewing back merges: the smallest dart's row survives and the new rows stay unused.
  touched.clear();
  repair.clear();
  REQUIRE(map.sew(2, DartId{2}, DartId{15}, &touched));
  vertices.repair(map, touched, repair);
  CHECK(repair.merged == 2);
  CHECK(repair.removed == std::vector<Row>{6, 7});
  CHECK(vertices.row(DartId{15}) == below);
  CHECK_FALSE(vertices.alive(6));
  CHECK(vertices.row_end() == 8);
  CHECK(vertices.orbit_count() == 6);
}

TEST_CASE("a repair visits only the touched orbits, however large the map") {
  GMap map = build_map(grid(40, 40, 1.0, 1.0, GridCells::Quads)).map;
  OrbitIndex vertices(map, kVertex);
  OrbitRepair repair;
  std::vector<DartId> touched;
  map.unsew(2, DartId{8 * (20 * 40 + 20) + 2}, &touched);
  vertices.repair(map, touched, repair);
  CHECK(repair.visited_darts == 16);
  CHECK(repair.orbits.size() == 2);
  CHECK(repair.split == 0);
}

TEST_CASE("few touched darts in any order give the same rows as sorted ones") {
  // Sparse and dense repairs order their orbits by different means.
  for (int stride : {5, 997}) {
    CAPTURE(stride);
    GMap map = build_map(grid(40, 40, 1.0, 1.0, GridCells::Triangles)).map;
    OrbitIndex vertices(map, kVertex);
    OrbitIndex twin = vertices;
    std::vector<DartId> touched;
    for (std::uint32_t d = 0; d < map.dart_end(); d += static_cast<std::uint32_t>(stride)) {
      map.unsew(2, DartId{d}, &touched);
    }
    OrbitRepair repair;
    vertices.repair(map, touched, repair);
    std::reverse(touched.begin(), touched.end());
    OrbitRepair again;
    twin.repair(map, touched, again);
    CHECK(std::equal(vertices.rows().begin(), vertices.rows().end(), twin.rows().begin()));
    CHECK(repair.removed == again.removed);
    REQUIRE(repair.orbits.size() == again.orbits.size());
    for (std::size_t k = 0; k < repair.orbits.size(); ++k) {
      CHECK(repair.orbits[k].smallest == again.orbits[k].smallest);
      CHECK(std::ranges::equal(repair.sources_of(repair.orbits[k]),
                               again.sources_of(again.orbits[k])));
      if (k > 0) CHECK(repair.orbits[k - 1].smallest < repair.orbits[k].smallest);
    }
  }
}

TEST_CASE("removed and created darts") {
  GMap map = build_map(grid(1, 1, 1.0, 1.0, GridCells::Quads)).map;
  OrbitIndex faces(map, OrbitType{0, 1});
  std::vector<DartId> touched = tests::naive_orbits(map, OrbitType{0, 1}).size() == 1
                                    ? orbit_darts(map, OrbitType{0, 1}, DartId{0})
                                    : std::vector<DartId>{};
  map.remove_darts(touched);
  touched.push_back(map.add_dart());
  OrbitRepair repair;
  faces.repair(map, touched, repair);
  CHECK(repair.removed == std::vector<Row>{0});
  CHECK(repair.created == 1);
  CHECK(faces.row(DartId{0}) == kNoRow);
  CHECK(faces.row(DartId{8}) == 1);
  CHECK(faces.orbit_count() == 1);
}

TEST_CASE("results of several repairs add up") {
  GMap map = build_map(grid(2, 1, 1.0, 1.0, GridCells::Quads)).map;
  OrbitIndex vertices(map, kVertex), edges(map, OrbitType{0, 2});
  std::vector<DartId> touched;
  map.unsew(2, DartId{2}, &touched);
  OrbitRepair repair;
  vertices.repair(map, touched, repair);
  const std::size_t first = repair.orbits.size();
  edges.repair(map, touched, repair);
  REQUIRE(repair.orbits.size() == first + 2);
  CHECK(repair.split == 3);
  CHECK(repair.sources_of(repair.orbits.back()).size() == 1);
}

TEST_CASE("a rewrite that knows its orbits names them itself, and a journal takes it back") {
  GMap map = build_map(grid(2, 1, 1.0, 1.0, GridCells::Quads)).map;
  EmbeddingSchema schema;
  EmbeddingStore store(schema, map);
  OrbitIndex& edges = store.use_index(OrbitType{0, 2});
  Journal journal;
  map.set_journal(&journal);
  const DartId first = map.add_darts(3), second{index(first) + 1}, third{index(first) + 2};
  edges.grow(map, &journal);
  const auto links = map.new_links(0, first);
  links[0] = second;
  links[1] = first;
  CHECK(edges.add_orbit(std::vector{first, second}, &journal) == 7);
  CHECK(edges.smallest(7) == first);
  edges.add_orbit(std::vector{third}, &journal);
  CHECK(edges.orbit_count() == 9);
  CHECK(validate(map, store).empty());
  map.link(2, third, DartId{0});
  CHECK(edges.merge(map, third, DartId{0}, &journal) == 8);
  CHECK(edges.row(third) == 0);
  CHECK(edges.merge(map, third, DartId{0}, &journal) == kNoRow);
  CHECK_THROWS_AS((void)map.new_links(0, DartId{3}), support::InternalError);
  journal.roll_back(map, store);
  CHECK(edges.row_end() == 7);
  CHECK(edges.orbit_count() == 7);
  CHECK(map.dart_end() == 16);
  CHECK(validate(map, store).empty());
}
