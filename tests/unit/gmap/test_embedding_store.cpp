// SPDX-License-Identifier: MIT
#include "gmap/embedding_store.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "gmap/journal.h"
#include "support/mesh_groups.h"

using namespace gmsim;
using namespace gmsim::gmap;

namespace {

EmbeddingDecl declaration(std::string name, OrbitType orbit) {
  EmbeddingDecl decl;
  decl.name = std::move(name);
  decl.type = {types::ValueKind::Vec3};
  decl.orbit = orbit;
  return decl;
}

}  // namespace

TEST_CASE("schemas find by name, the newest first") {
  EmbeddingSchema schema;
  const auto first = schema.add(declaration("position", OrbitType{1, 2}));
  CHECK(schema.find("position") == first);
  const auto second = schema.add(declaration("position", OrbitType{1, 2}));
  CHECK(schema.find("position") == second);
  CHECK_FALSE(schema.find("velocity"));
  CHECK(schema.size() == 2);
}

TEST_CASE("a column starts with the default, or without values") {
  const MeshMap built = build_map(grid(2, 2, 1.0, 1.0, GridCells::Quads));
  EmbeddingSchema schema;
  const auto position = schema.add(declaration("position", OrbitType{1, 2}));
  EmbeddingDecl with_default = declaration("velocity", OrbitType{1, 2});
  with_default.default_value = types::Value::vec3(1, 2, 3);
  const auto velocity = schema.add(with_default);
  EmbeddingStore store(schema, built.map);
  CHECK_FALSE(store.in_use(position));
  CHECK_THROWS_AS((void)store.column(position), support::InternalError);
  store.use(position);
  store.use(velocity);
  CHECK(store.indices().size() == 1);
  CHECK(&store.index_of(position) == store.find_index(OrbitType{1, 2}));
  CHECK(store.find_index(OrbitType{0, 1}) == nullptr);
  CHECK(store.column(velocity).row_end() == 9);
  CHECK(store.column(velocity).stride() == 3);
  CHECK(store.get(position, DartId{0}).empty());
  CHECK(store.get(velocity, DartId{5})[2] == 3.0);
  CHECK(store.embeddings() == std::vector{position, velocity});
}

TEST_CASE("a value is one for the whole orbit") {
  const MeshMap built = build_map(grid(2, 2, 1.0, 1.0, GridCells::Quads));
  EmbeddingSchema schema;
  const auto position = schema.add(declaration("position", OrbitType{1, 2}));
  EmbeddingStore store(schema, built.map);
  store.use(position);
  store.set(position, built.point_dart[4], std::array{1.0, 2.0, 3.0});
  for (std::uint32_t d = 0; d < built.map.dart_end(); ++d) {
    CHECK(store.get(position, DartId{d}).empty() == (built.dart_point[d] != 4));
  }
  CHECK_THROWS_AS(store.set(position, DartId{0}, std::array{1.0}), support::InternalError);
}

TEST_CASE("columns set, clear, copy and grow, and a journal takes it back") {
  const MeshMap built = build_map(grid(1, 1, 1.0, 1.0, GridCells::Quads));
  GMap map = built.map;
  EmbeddingSchema schema;
  const auto id = schema.add(declaration("position", OrbitType{1, 2}));
  EmbeddingStore store(schema, map);
  EmbeddingColumn& column = store.use(id);
  column.set(0, std::array{1.0, 2.0, 3.0});
  Journal journal;
  column.copy(0, 1, &journal);
  CHECK(column.get(1)[1] == 2.0);
  column.copy(2, 0, &journal);
  CHECK_FALSE(column.has(0));
  column.set(0, std::array{7.0, 8.0, 9.0}, &journal);
  column.clear(1, &journal);
  CHECK(column.get(1)[1] == 0.0);
  CHECK(journal.size() == 4);
  journal.roll_back(map, store);
  CHECK(column.has(0));
  CHECK(column.get(0)[2] == 3.0);
  CHECK_FALSE(column.has(1));
  CHECK_THROWS_AS(column.set(4, std::array{0.0, 0.0, 0.0}), support::InternalError);
}

TEST_CASE("derived embeddings have no column") {
  const MeshMap built = build_map(grid(1, 1, 1.0, 1.0, GridCells::Quads));
  EmbeddingSchema schema;
  EmbeddingDecl mass = declaration("mass", OrbitType{1, 2});
  mass.kind = EmbeddingKind::Derived;
  const auto id = schema.add(mass);
  EmbeddingStore store(schema, built.map);
  CHECK_THROWS_AS(store.use(id), support::InternalError);
}

TEST_CASE("a column reads from elsewhere what is asked for, until it is set or the reading stops") {
  const MeshMap built = build_map(grid(2, 1, 1.0, 1.0, GridCells::Quads));
  EmbeddingSchema schema;
  const auto position = schema.add(declaration("position", OrbitType{1, 2}));
  EmbeddingStore store(schema, built.map);
  EmbeddingColumn& column = store.use(position);
  const auto set = [&](Row row, double x) {
    column.set(row, std::array{x, x + 0.1, x + 0.2});
  };
  for (Row row = 0; row < 6; ++row) set(row, row);
  std::vector<double> records;  // of four doubles, for the first five rows
  for (Row row = 0; row < 5; ++row)
    for (int k = 0; k < 4; ++k) records.push_back(100 + 10 * row + k);

  column.read_from(records.data(), 4, 5);
  CHECK(column.get(2)[0] == 120);
  CHECK(column.get(2)[2] == 122);
  CHECK(column.get(5)[0] == 5);  // is in no record
  CHECK_THROWS_AS((void)column.data(), support::InternalError);
  set(3, 33);
  CHECK(column.get(3)[0] == 33);
  column.copy(4, 0);
  CHECK(column.get(0)[1] == 141);
  records[4 * 2] = 7;  // read before: the copy stays
  CHECK(column.get(2)[0] == 120);
  column.read_from(records.data(), 4, 5);  // another moment: everything is read again
  CHECK(column.get(2)[0] == 7);
  CHECK(column.get(3)[0] == 130);
  column.stop_reading();
  CHECK(column.get(2)[0] == 7);
  CHECK(column.get(1)[0] == 1);  // nobody asked
  CHECK(column.get(0)[1] == 141);
  CHECK_NOTHROW((void)column.data());
  CHECK_THROWS_AS(column.read_from(records.data(), 2, 5), support::InternalError);
  CHECK_THROWS_AS(column.read_from(records.data(), 4, 7), support::InternalError);
}
