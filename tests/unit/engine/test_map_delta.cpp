// SPDX-License-Identifier: MIT
#include "engine/map_delta.h"

#include <doctest/doctest.h>

#include <map>

#include "support/particle_world.h"

using namespace gmsim;
using compile::Aspects;
using compile::kEverything;
using engine::Effects;
using engine::MapDelta;
using tests::ParticleWorld;
using types::DartId;
using types::OrbitType;

namespace {

const OrbitType kVertex{1};  // of a chain

std::map<std::uint32_t, Aspects> by_dart(const MapDelta& delta) {
  std::map<std::uint32_t, Aspects> result;
  for (const auto& [dart, what] : delta.darts) {
    CHECK_MESSAGE(result.emplace(types::index(dart), what).second, "a dart is named twice");
    CHECK(types::index(dart) == result.rbegin()->first);
  }
  return result;
}

/// A chain of three particles, darts 0-1 and 2-3, cut between 1 and 2.
struct CutChain {
  ParticleWorld world{3};
  Effects effects;

  CutChain() {
    engine::State& state = world.state;
    const DartId first = state.map.alpha(0, world.dart(0));
    REQUIRE(state.map.alpha(1, first) != first);
    state.map.unsew(1, first, &effects.touched);
    effects.applications = 1;
    effects.changed_links = OrbitType{1};
    state.store.use_index(kVertex).repair(state.map, effects.touched, effects.repair(kVertex));
    state.store.grow_columns();
  }
};

}  // namespace

TEST_CASE("a cut changes links of the touched darts and the row of one part") {
  const CutChain chain;
  REQUIRE(chain.effects.touched.size() == 2);
  const MapDelta delta = engine::map_delta(chain.world.state, chain.effects);
  const gmap::OrbitIndex& vertices = *chain.world.state.store.find_index(kVertex);
  const auto what = by_dart(delta);
  REQUIRE(what.size() == 2);
  std::size_t renumbered = 0;
  for (const auto& [dart, aspects] : what) {
    CAPTURE(dart);
    CHECK((aspects & compile::links(OrbitType{1})) != 0);
    CHECK((aspects & compile::links(OrbitType{0})) == 0);
    CHECK((aspects & compile::links_of_numbers(OrbitType{1})) != 0);
    CHECK((aspects & compile::values_of(kVertex)) != 0);
    CHECK((aspects & (compile::kLife | compile::kForceList)) == 0);
    const bool has_new_row = vertices.row(DartId{dart}) + 1 == vertices.row_end();
    CHECK(((aspects & compile::row_of(kVertex)) != 0) == has_new_row);
    renumbered += has_new_row ? 1 : 0;
  }
  CHECK(renumbered == 1);
  // Both parts of the vertex, nobody else.
  CHECK(delta.vertices.size() == 2);
  for (const gmap::Row row : delta.vertices)
    CHECK(what.contains(types::index(vertices.smallest(row))));
}

TEST_CASE("of a changed value, of new darts and of dead ones everything has changed") {
  CutChain chain;
  chain.effects.written.push_back({OrbitType{0}, chain.world.dart(0)});
  auto what = by_dart(engine::map_delta(chain.world.state, chain.effects));
  const DartId other_end = chain.world.state.map.alpha(0, chain.world.dart(0));
  CHECK(what.size() == 3);
  CHECK(what[types::index(chain.world.dart(0))] == kEverything);
  CHECK(what[types::index(other_end)] == kEverything);

  chain.effects.written.clear();
  chain.effects.created_darts = 1;  // which of the touched ones is not told
  what = by_dart(engine::map_delta(chain.world.state, chain.effects));
  for (const DartId dart : chain.effects.touched) CHECK(what[types::index(dart)] == kEverything);
}

TEST_CASE("a dart that moved on to a third orbit within one step has another row") {
  // The row of the middle vertex goes from one part to another although the last repair leaves it.
  CutChain chain;
  Effects later;
  const DartId moved = chain.effects.touched.front() > chain.effects.touched.back()
                           ? chain.effects.touched.front()
                           : chain.effects.touched.back();
  const gmap::Row row = chain.world.state.store.find_index(kVertex)->row(moved);
  gmap::OrbitRepair& repair = later.repair(kVertex);
  repair.orbits.push_back({row, moved, 0, 1});
  repair.sources.push_back(row);
  repair.visited_darts = 1;
  chain.effects.append(later);
  const auto what = by_dart(engine::map_delta(chain.world.state, chain.effects));
  CHECK((what.at(types::index(moved)) & compile::row_of(kVertex)) != 0);
}

TEST_CASE("aspects of different kinds have no bit in common") {
  const OrbitType all = OrbitType::range(0, types::kMaxDimension);
  const Aspects kinds[] = {compile::links(all), compile::links_of_numbers(all), compile::kLife,
                           compile::kForceList, compile::row_of(kVertex),
                           compile::values_of(kVertex)};
  Aspects seen = 0;
  for (const Aspects kind : kinds) {
    CHECK((seen & kind) == 0);
    seen |= kind;
  }
  for (std::uint8_t bits = 0; bits < 16; ++bits) {
    const OrbitType type = OrbitType::from_bits(bits);
    CHECK((compile::values_of(type) & compile::kAllValues) == compile::values_of(type));
    CHECK((compile::row_of(type) & (compile::kAllValues | compile::kShape)) == 0);
  }
}
