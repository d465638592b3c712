// SPDX-License-Identifier: MIT
// What holds for every map, on all mesh groups and on random maps, degenerate ones included.
#include <doctest/doctest.h>

#include <numeric>

#include "gmap/journal.h"
#include "gmap/orbit_index.h"
#include "gmap/orbit_walk.h"
#include "gmap/validate.h"
#include "support/map_oracle.h"
#include "support/mesh_groups.h"

using namespace gmsim;
using namespace gmsim::gmap;
using namespace gmsim::tests;

namespace {

struct NamedMap {
  std::string name;
  GMap map;
};

/// Every mesh group and `count` random maps of each dimension.
std::vector<NamedMap> all_maps(std::uint64_t seed, int count) {
  std::vector<NamedMap> maps;
  for (const NamedMesh& group : mesh_groups()) {
    maps.push_back({group.name, build_map(group.mesh).map});
  }
  std::mt19937_64 random(seed);
  for (int k = 0; k < count; ++k) {
    for (int n = 1; n <= 3; ++n) {
      const auto darts = static_cast<std::uint32_t>(1 + random() % 40);
      const std::uint64_t map_seed = random();
      maps.push_back({"random " + std::to_string(map_seed), random_map(n, darts, map_seed)});
    }
  }
  return maps;
}

/// Every kind of map among so many free darts that a change touches only a small part of it:
/// repairs go another way then.
std::vector<NamedMap> sparse_maps(std::uint64_t seed, int count) {
  std::vector<NamedMap> maps = all_maps(seed, count);
  for (auto& [name, map] : maps) {
    name += " among free darts";
    map.add_darts(400);
  }
  return maps;
}

std::vector<std::string> no_problems() {
  return {};
}

/// What repair must do, computed from the rows before and the orbits after.
struct ExpectedRepair {
  std::map<DartId, std::pair<Row, std::set<Row>>> orbits;  // by smallest dart: row and sources
  std::set<Row> removed;
  Row row_end = 0;
};

ExpectedRepair expected_repair(const GMap& map, OrbitType type, const std::vector<Row>& rows,
                               Row row_end, const std::vector<DartId>& touched) {
  const auto old_row = [&](DartId d) { return index(d) < rows.size() ? rows[index(d)] : kNoRow; };
  const std::set<DartId> touched_set(touched.begin(), touched.end());
  ExpectedRepair expected;
  std::set<Row> met, claimed;
  for (DartId d : touched_set) {
    if (!map.alive(d) && old_row(d) != kNoRow) met.insert(old_row(d));
  }
  for (const auto& orbit : naive_orbits(map, type)) {
    if (std::none_of(orbit.begin(), orbit.end(),
                     [&](DartId d) { return touched_set.contains(d); })) {
      continue;
    }
    auto& [row, sources] = expected.orbits[*orbit.begin()];
    for (DartId d : orbit) {
      if (old_row(d) != kNoRow) sources.insert(old_row(d));
    }
    met.insert(sources.begin(), sources.end());
    row = old_row(*orbit.begin());
    if (row == kNoRow || !claimed.insert(row).second) row = row_end++;
  }
  for (Row row : met) {
    if (!claimed.contains(row)) expected.removed.insert(row);
  }
  expected.row_end = row_end;
  return expected;
}

void check_repair(const OrbitRepair& repair, const ExpectedRepair& expected) {
  REQUIRE(repair.orbits.size() == expected.orbits.size());
  auto wanted = expected.orbits.begin();
  std::uint32_t created = 0, split = 0, merged = 0;
  for (const OrbitChange& change : repair.orbits) {
    CHECK(change.smallest == wanted->first);
    CHECK(change.row == wanted->second.first);
    const auto sources = repair.sources_of(change);
    CHECK(std::vector<Row>(sources.begin(), sources.end()) ==
          std::vector<Row>(wanted->second.second.begin(), wanted->second.second.end()));
    created += sources.empty();
    merged += sources.size() > 1;
    split += !sources.empty() && !wanted->second.second.contains(change.row);
    ++wanted;
  }
  CHECK(repair.created == created);
  CHECK(repair.split == split);
  CHECK(repair.merged == merged);
  CHECK(std::set<Row>(repair.removed.begin(), repair.removed.end()) == expected.removed);
  CHECK(repair.removed.size() == expected.removed.size());
}

/// The index groups the darts as one made anew does, with the same smallest darts.
void check_equals_rebuilt(const OrbitIndex& orbits, const GMap& map) {
  const OrbitIndex rebuilt(map, orbits.type());
  REQUIRE(orbits.rows().size() == rebuilt.rows().size());
  CHECK(orbits.orbit_count() == rebuilt.orbit_count());
  for (std::uint32_t d = 0; d < map.dart_end(); ++d) {
    const Row row = orbits.row(DartId{d}), other = rebuilt.row(DartId{d});
    CHECK((row == kNoRow) == (other == kNoRow));
    if (row != kNoRow) CHECK(orbits.smallest(row) == rebuilt.smallest(other));
  }
}

/// One intensive real embedding for each orbit type, with a different value in each row.
EmbeddingSchema schema_of_all_types(int dimension) {
  EmbeddingSchema schema;
  for (OrbitType type : all_types(dimension)) {
    EmbeddingDecl decl;
    decl.name = "x" + to_string(type);
    decl.type = {types::ValueKind::Vec2};
    decl.orbit = type;
    decl.optional = index(DartId{type.bits()}) % 3 == 0;
    schema.add(decl);
  }
  return schema;
}

void fill_columns(EmbeddingStore& store) {
  for (std::size_t k = 0; k < store.schema().size(); ++k) {
    const auto id = static_cast<types::EmbeddingId>(k);
    EmbeddingColumn& column = store.use(id);
    for (Row row = 0; row < column.row_end(); ++row) {
      const std::array<double, 2> value{double(row) + 0.25, double(k)};
      if (!column.optional() || row % 2 == 0) column.set(row, value);
    }
  }
}

/// Repairs every index and lets columns follow: the first source's value, or a fresh one.
void repair_all(const GMap& map, EmbeddingStore& store, const std::vector<DartId>& touched,
                Journal* journal) {
  OrbitRepair repair;
  for (const auto& orbits : store.indices()) {
    repair.clear();
    orbits->repair(map, touched, repair, journal);
    store.grow_columns(journal);
    for (types::EmbeddingId id : store.embeddings()) {
      if (&store.index_of(id) != orbits.get()) continue;
      EmbeddingColumn& column = store.column(id);
      for (const OrbitChange& change : repair.orbits) {
        if (change.sources_count == 0) {
          column.set(change.row, std::array<double, 2>{-1.0, -2.0}, journal);
        } else {
          column.copy(repair.sources_of(change).front(), change.row, journal);
        }
      }
      for (Row row : repair.removed) column.clear(row, journal);
    }
  }
}

/// Everything a map and its store hold.
struct Snapshot {
  std::vector<std::vector<DartId>> alpha;
  std::uint32_t alive;
  std::vector<std::vector<Row>> rows;
  std::vector<std::vector<DartId>> smallest;
  std::vector<Row> counts;
  std::vector<std::vector<double>> data;
  std::vector<std::vector<bool>> present;
  bool operator==(const Snapshot&) const = default;
};

Snapshot snapshot(const GMap& map, const EmbeddingStore& store) {
  Snapshot all;
  for (int i = 0; i <= map.dimension(); ++i) {
    all.alpha.emplace_back(map.alphas(i).begin(), map.alphas(i).end());
  }
  all.alive = map.dart_count();
  for (const auto& orbits : store.indices()) {
    all.rows.emplace_back(orbits->rows().begin(), orbits->rows().end());
    all.smallest.emplace_back();
    for (Row row = 0; row < orbits->row_end(); ++row) {
      all.smallest.back().push_back(orbits->smallest(row));
    }
    all.counts.push_back(orbits->orbit_count());
  }
  for (types::EmbeddingId id : store.embeddings()) {
    const EmbeddingColumn& column = store.column(id);
    all.data.emplace_back(column.data().begin(), column.data().end());
    all.present.emplace_back();
    for (Row row = 0; row < column.row_end(); ++row) all.present.back().push_back(column.has(row));
  }
  return all;
}

}  // namespace

TEST_CASE("mesh groups and random maps are valid") {
  for (const auto& [name, map] : all_maps(1, 200)) {
    CAPTURE(name);
    CHECK(validate(map) == no_problems());
    for (std::uint32_t d = 0; d < map.dart_end(); ++d) {
      for (int i = 0; i <= map.dimension(); ++i) {
        CHECK(map.alpha(i, map.alpha(i, DartId{d})) == DartId{d});
        for (int j = i + 2; j <= map.dimension(); ++j) {
          const DartId once = map.alpha(j, map.alpha(i, DartId{d}));
          CHECK(map.alpha(j, map.alpha(i, once)) == DartId{d});
        }
      }
    }
  }
}

TEST_CASE("walks visit each dart of the orbit once, from every dart and for every type") {
  for (const auto& [name, map] : all_maps(2, 60)) {
    CAPTURE(name);
    for (OrbitType type : all_types(map.dimension())) {
      CAPTURE(to_string(type));
      for (std::uint32_t d = 0; d < map.dart_end(); d += 1 + map.dart_end() / 40) {
        const auto orbit = naive_orbit(map, type, DartId{d});
        std::vector<DartId> walked;
        for_each_dart(map, type, DartId{d}, [&](DartId x) { walked.push_back(x); });
        CHECK(walked.front() == DartId{d});
        CHECK(walked.size() == orbit.size());
        CHECK(std::set<DartId>(walked.begin(), walked.end()) == orbit);
      }
    }
  }
}

TEST_CASE("a fresh index has one row per orbit, found by every dart") {
  for (const auto& [name, map] : all_maps(3, 60)) {
    CAPTURE(name);
    for (OrbitType type : all_types(map.dimension())) {
      CAPTURE(to_string(type));
      const OrbitIndex orbits(map, type);
      const auto expected = naive_orbits(map, type);
      REQUIRE(orbits.row_end() == expected.size());
      CHECK(orbits.orbit_count() == expected.size());
      for (Row row = 0; row < orbits.row_end(); ++row) {
        CHECK(orbits.smallest(row) == *expected[row].begin());
        for (DartId d : expected[row]) CHECK(orbits.row(d) == row);
      }
    }
  }
}

TEST_CASE("quotients hold one dart of the outer orbit for each inner orbit") {
  for (const auto& [name, map] : all_maps(4, 20)) {
    CAPTURE(name);
    std::mt19937_64 random(17);
    for (OrbitType outer : all_types(map.dimension())) {
      for (OrbitType inner : all_types(map.dimension())) {
        const DartId d{static_cast<std::uint32_t>(random() % map.dart_end())};
        std::map<DartId, DartId> smallest;  // of the inner orbit -> of those in both
        for (DartId x : naive_orbit(map, outer, d)) {
          smallest.try_emplace(*naive_orbit(map, inner, x).begin(), x);
        }
        std::set<DartId> expected;
        for (const auto& entry : smallest) expected.insert(entry.second);
        const auto found = quotient(map, outer, inner, d);
        CHECK(found == std::vector<DartId>(expected.begin(), expected.end()));
      }
    }
  }
}

TEST_CASE("sew links isomorphic free orbits pair by pair, and unsew restores the map") {
  std::mt19937_64 random(5);
  int sewn = 0;
  for (auto& [name, map] : all_maps(5, 150)) {
    CAPTURE(name);
    for (int attempt = 0; attempt < 40; ++attempt) {
      const int i = static_cast<int>(random() % static_cast<unsigned>(map.dimension() + 1));
      const DartId a{static_cast<std::uint32_t>(random() % map.dart_end())};
      const DartId b{static_cast<std::uint32_t>(random() % map.dart_end())};
      const GMap before = map;
      std::vector<DartId> touched;
      const bool possible = map.can_sew(i, a, b);
      REQUIRE(map.sew(i, a, b, &touched) == possible);
      const auto orbit = naive_orbit(map, map.sew_type(i), a);
      CHECK(validate(map) == no_problems());
      if (!possible) {
        CHECK(touched.empty());
        continue;
      }
      ++sewn;
      CHECK(map.alpha(i, a) == b);
      CHECK(touched.size() == 2 * orbit.size());
      map.unsew(i, b);
      for (int k = 0; k <= map.dimension(); ++k) {
        CHECK(std::equal(map.alphas(k).begin(), map.alphas(k).end(), before.alphas(k).begin()));
      }
    }
  }
  CHECK(sewn > 300);
}

TEST_CASE("can_sew agrees with the definition") {
  // An isomorphism exists when walking the same links from both darts never disagrees.
  std::mt19937_64 random(6);
  for (const auto& [name, map] : all_maps(6, 100)) {
    CAPTURE(name);
    for (int attempt = 0; attempt < 30; ++attempt) {
      const int i = static_cast<int>(random() % static_cast<unsigned>(map.dimension() + 1));
      const DartId a{static_cast<std::uint32_t>(random() % map.dart_end())};
      const DartId b{static_cast<std::uint32_t>(random() % map.dart_end())};
      const OrbitType type = map.sew_type(i);
      const auto orbit_a = naive_orbit(map, type, a), orbit_b = naive_orbit(map, type, b);
      bool expected = orbit_a.size() == orbit_b.size() && !orbit_a.contains(b);
      std::map<DartId, DartId> image{{a, b}};
      std::vector<DartId> todo{a};
      while (expected && !todo.empty()) {
        const DartId x = todo.back();
        todo.pop_back();
        expected = map.is_free(i, x) && map.is_free(i, image.at(x));
        for (int k = 0; k <= map.dimension() && expected; ++k) {
          if (!type.contains(k)) continue;
          const DartId y = map.alpha(k, image.at(x));
          const auto [entry, inserted] = image.try_emplace(map.alpha(k, x), y);
          if (inserted) todo.push_back(map.alpha(k, x));
          expected = entry->second == y;
        }
      }
      CHECK(map.can_sew(i, a, b) == expected);
    }
  }
}

namespace {

/// How many events of each kind were seen.
struct Events {
  std::uint32_t created = 0, split = 0, merged = 0, removed = 0;
  void add(const OrbitRepair& repair) {
    created += repair.created;
    split += repair.split;
    merged += repair.merged;
    removed += static_cast<std::uint32_t>(repair.removed.size());
  }
  [[nodiscard]] std::uint32_t fewest() const { return std::min({created, split, merged, removed}); }
};

Events repair_at_random(GMap& map, std::vector<OrbitType> types, std::uint64_t seed, int batch) {
  Events events;
  std::mt19937_64 random(seed);
  std::vector<OrbitIndex> indices;
  for (OrbitType type : types) indices.emplace_back(map, type);
  RandomChanges changes(map, random());
  OrbitRepair repair;
  for (int round = 0; round < 8; ++round) {
    std::vector<DartId> touched;
    for (int k = 0; k < batch; ++k) changes.change(touched);
    REQUIRE(validate(map) == no_problems());
    std::shuffle(touched.begin(), touched.end(), random);
    for (OrbitIndex& orbits : indices) {
      CAPTURE(to_string(orbits.type()));
      const std::vector<Row> rows(orbits.rows().begin(), orbits.rows().end());
      const auto expected = expected_repair(map, orbits.type(), rows, orbits.row_end(), touched);
      repair.clear();
      orbits.repair(map, touched, repair);
      check_repair(repair, expected);
      CHECK(orbits.row_end() == expected.row_end);
      check_equals_rebuilt(orbits, map);
      events.add(repair);
    }
  }
  return events;
}

}  // namespace

TEST_CASE("repair after random changes names rows as documented and equals a rebuilt index") {
  std::mt19937_64 random(7);
  std::uint32_t fewest = 0;
  for (auto& [name, map] : all_maps(7, 60)) {
    CAPTURE(name);
    const std::uint64_t seed = random();
    CAPTURE(seed);
    const int batch = 1 + static_cast<int>(random() % 6);
    fewest += repair_at_random(map, all_types(map.dimension()), seed, batch).fewest();
  }
  CHECK(fewest > 500);  // the changes exercise every kind of event
}

TEST_CASE("the same in a large map of which little is touched") {
  std::mt19937_64 random(11);
  std::uint32_t fewest = 0;
  for (auto& [name, map] : sparse_maps(11, 15)) {
    CAPTURE(name);
    const std::uint64_t seed = random();
    CAPTURE(seed);
    const int n = map.dimension();
    const OrbitType vertex = OrbitType::cell(0, n), face = OrbitType::cell(n, n);
    fewest += repair_at_random(map, {vertex, face, OrbitType{0}, OrbitType{}}, seed, 2).fewest();
  }
  CHECK(fewest > 10);
}

TEST_CASE("merging rows link by link does what a repair does") {
  std::mt19937_64 random(12);
  int merged = 0;
  for (auto& [name, map] : all_maps(12, 60)) {
    CAPTURE(name);
    const std::uint64_t seed = random();
    CAPTURE(seed);
    std::mt19937_64 choices(seed);
    std::vector<OrbitIndex> repaired, by_links;
    for (OrbitType type : all_types(map.dimension())) repaired.emplace_back(map, type);
    by_links = repaired;
    for (int round = 0; round < 60; ++round) {
      const int i = static_cast<int>(choices() % static_cast<unsigned>(map.dimension() + 1));
      const auto any = [&] {
        return DartId{static_cast<std::uint32_t>(choices() % map.dart_end())};
      };
      std::vector<DartId> touched;
      if (!map.sew(i, any(), any(), &touched)) continue;
      OrbitRepair repair;
      for (std::size_t k = 0; k < repaired.size(); ++k) {
        if (!repaired[k].type().contains(i)) continue;
        repaired[k].repair(map, touched, repair);
        for (std::size_t t = 0; t < touched.size(); t += 2) {
          merged += by_links[k].merge(map, touched[t], touched[t + 1]) != kNoRow;
        }
        CAPTURE(to_string(repaired[k].type()));
        CHECK(std::ranges::equal(repaired[k].rows(), by_links[k].rows()));
        check_equals_rebuilt(by_links[k], map);
      }
    }
  }
  CHECK(merged > 400);
}

TEST_CASE("what one repair does for many changes, repairs after each do up to names") {
  std::mt19937_64 random(8);
  for (auto& [name, map] : all_maps(8, 30)) {
    CAPTURE(name);
    GMap twin = map;
    std::vector<OrbitIndex> at_once, step_by_step;
    for (OrbitType type : all_types(map.dimension())) {
      at_once.emplace_back(map, type);
      step_by_step.emplace_back(twin, type);
    }
    const std::uint64_t seed = random();
    CAPTURE(seed);
    RandomChanges changes(map, seed), twin_changes(twin, seed);
    std::vector<DartId> all_touched;
    OrbitRepair repair;
    for (int k = 0; k < 12; ++k) {
      changes.change(all_touched);
      std::vector<DartId> touched;
      twin_changes.change(touched);
      for (OrbitIndex& orbits : step_by_step) orbits.repair(twin, touched, repair);
    }
    for (OrbitIndex& orbits : at_once) {
      orbits.repair(map, all_touched, repair);
      check_equals_rebuilt(orbits, map);
    }
    for (OrbitIndex& orbits : step_by_step) check_equals_rebuilt(orbits, map);
  }
}

TEST_CASE("rolling back restores map, indices and columns bitwise") {
  std::mt19937_64 random(9);
  for (auto& [name, map] : all_maps(9, 40)) {
    CAPTURE(name);
    const EmbeddingSchema schema = schema_of_all_types(map.dimension());
    EmbeddingStore store(schema, map);
    fill_columns(store);
    const std::uint64_t seed = random();
    CAPTURE(seed);
    RandomChanges changes(map, seed);
    Journal journal;
    for (int operation = 0; operation < 4; ++operation) {
      const Snapshot before = snapshot(map, store);
      map.set_journal(&journal);
      for (int round = 0; round < 3; ++round) {
        std::vector<DartId> touched;
        for (int k = 0; k < 3; ++k) changes.change(touched);
        repair_all(map, store, touched, &journal);
      }
      map.set_journal(nullptr);
      CHECK(validate(map, store) == no_problems());
      if (operation % 2 == 0) {
        journal.roll_back(map, store);
        CHECK((snapshot(map, store) == before));
        CHECK(validate(map, store) == no_problems());
      } else {
        journal.commit();
      }
      CHECK(journal.size() == 0);
    }
  }
}

TEST_CASE("renaming darts renames orbits and nothing else") {
  std::mt19937_64 random(10);
  for (const auto& [name, map] : all_maps(10, 60)) {
    CAPTURE(name);
    std::vector<std::uint32_t> new_id(map.dart_end());
    std::iota(new_id.begin(), new_id.end(), 0u);
    std::shuffle(new_id.begin(), new_id.end(), random);
    const GMap other = renamed(map, new_id);
    CHECK(validate(other) == no_problems());
    for (OrbitType type : all_types(map.dimension())) {
      const OrbitIndex orbits(map, type), renamed_orbits(other, type);
      CHECK(orbits.orbit_count() == renamed_orbits.orbit_count());
      CHECK(all_orbits(map, type).size() == orbits.orbit_count());
      std::map<Row, Row> match;
      for (std::uint32_t d = 0; d < map.dart_end(); ++d) {
        const Row row = renamed_orbits.row(DartId{new_id[d]});
        CHECK(match.try_emplace(orbits.row(DartId{d}), row).first->second == row);
      }
    }
  }
}
