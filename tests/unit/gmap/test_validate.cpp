// SPDX-License-Identifier: MIT
#include "gmap/validate.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "support/mesh_groups.h"

using namespace gmsim;
using namespace gmsim::gmap;

namespace {

GMap quads() {
  return build_map(grid(2, 2, 1.0, 1.0, GridCells::Quads)).map;
}

bool mentions(const std::vector<std::string>& problems, std::string_view text) {
  return std::ranges::any_of(problems,
                             [&](const std::string& p) { return p.find(text) != p.npos; });
}

}  // namespace

TEST_CASE("a link that leads one way only is found") {
  GMap map = quads();
  map.set_alpha(2, DartId{2}, DartId{2});
  const auto problems = validate(map);
  REQUIRE(problems.size() == 1);
  CHECK(problems[0] == "dart 15: its 2-link leads to dart 2, whose 2-link leads to dart 2");
}

TEST_CASE("a link to a removed dart is found") {
  GMap map = quads();
  map.set_alpha(1, DartId{2}, DartId{4000});
  CHECK(mentions(validate(map), "dart 4000, which is not alive"));
}

TEST_CASE("an open cycle is found") {
  GMap map = quads();
  map.unlink(2, DartId{2});
  CHECK(mentions(validate(map), "dart 2: @0@2 is dart"));
}

TEST_CASE("no more than the limit is reported") {
  GMap map = quads();
  for (std::uint32_t d = 0; d < map.dart_end(); d += 2) map.set_alpha(0, DartId{d}, DartId{d});
  CHECK(validate(map, 3).size() == 3);
}

TEST_CASE("an index that was not repaired is found") {
  GMap map = quads();
  EmbeddingSchema schema;
  EmbeddingStore store(schema, map);
  store.use_index(OrbitType{1, 2});
  CHECK(validate(map, store).empty());
  map.unsew(2, DartId{2});
  CHECK_FALSE(validate(map, store).empty());
  map.add_dart();
  CHECK(mentions(validate(map, store), "index <1,2>: 32 darts, but the map has 33"));
}

TEST_CASE("an index that keeps a removed dart is found") {
  GMap map = quads();
  EmbeddingSchema schema;
  EmbeddingStore store(schema, map);
  store.use_index(OrbitType{1});
  const DartId d = map.add_dart();
  OrbitRepair repair;
  store.use_index(OrbitType{1}).repair(map, std::vector{d}, repair);
  CHECK(validate(map, store).empty());
  map.remove_dart(d);
  CHECK(mentions(validate(map, store), "dart 32 is not alive but has row 16"));
}

TEST_CASE("a missing value is found unless the embedding is optional") {
  GMap map = quads();
  EmbeddingSchema schema;
  EmbeddingDecl decl;
  decl.name = "heat";
  decl.type = {types::ValueKind::Real};
  decl.orbit = OrbitType{0, 1};
  const auto heat = schema.add(decl);
  decl.name = "age";
  decl.optional = true;
  const auto age = schema.add(decl);
  EmbeddingStore store(schema, map);
  store.use(age);
  CHECK(validate(map, store).empty());
  store.use(heat);
  CHECK(mentions(validate(map, store), "`heat`: no value for the orbit <0,1> of dart 0"));
}
