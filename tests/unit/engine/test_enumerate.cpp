// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "engine/enumerate.h"
#include "gmap/mesh_builders.h"
#include "gmap/orbit_walk.h"
#include "support/engine_rules.h"
#include "support/mesh_groups.h"

using namespace gmsim;
using namespace gmsim::tests;
using types::DartId;
using types::OrbitType;

namespace {

const char* const kRules = R"(
embedding position : vec3 [m] on vertex merge mean;
embedding mark : bool on face optional;
rule edge(a) { left { a -0- b; } }
rule inner(a) { left { a<0> -2- b<0>; } }
rule border(a) { left { a; } where free(a, 2); }
rule right_side(a) { left { a; } where a.position.x > 0.5; }
rule open(a) { left { a; } where count(x in polygon(a)) == 4; }
)";

/// By the definition: for each orbit the first dart, ascending, at which the rule matches.
std::vector<DartId> by_definition(const engine::State& state, const compile::Rule& rule,
                                  OrbitType orbit) {
  std::vector<DartId> result;
  engine::Matcher matcher(state);
  engine::Match match;
  for (DartId smallest : gmap::all_orbits(state.map, orbit)) {
    for (DartId d : gmap::orbit_darts(state.map, orbit, smallest)) {
      engine::Frame frame(rule.frame_size);
      if (!matcher.match(rule.match, {&d, 1}, frame, match)) continue;
      result.push_back(d);
      break;
    }
  }
  return result;
}

}  // namespace

TEST_CASE("one match for each orbit, at its first dart, on every mesh") {
  const RuleBook rules(kRules, 2);
  for (const NamedMesh& mesh : mesh_groups()) {
    if (mesh.mesh.dimension != 2) continue;
    CAPTURE(mesh.name);
    const auto state = make_state(rules.program(), mesh.mesh);
    engine::Matcher matcher(*state);
    for (const char* name : {"edge", "inner", "border", "right_side"}) {
      CAPTURE(name);
      const compile::Rule& rule = rules.rule(name);
      for (unsigned bits = 0; bits < 8; ++bits) {
        const OrbitType orbit = OrbitType::from_bits(static_cast<std::uint8_t>(bits));
        const engine::Candidates found =
            engine::candidates(matcher, *state, rule, {}, {.orbit = orbit});
        REQUIRE(!found.error);
        CHECK(found.darts == by_definition(*state, rule, orbit));
      }
    }
  }
}

TEST_CASE("the default orbit of a rule is that of its hook's label") {
  const RuleBook rules(kRules, 2);
  CHECK(rules.rule("inner").match.hook_orbit() == OrbitType{0});
  CHECK(rules.rule("edge").match.hook_orbit() == OrbitType{});
}

TEST_CASE("the first dart may be chosen by a condition, and must exist") {
  const RuleBook rules(kRules, 2);
  const auto state = make_state(rules.program(), gmap::grid(2, 1, 2.0, 1.0, gmap::GridCells::Quads));
  engine::Matcher matcher(*state);
  const compile::Rule& rule = rules.rule("edge");
  const auto chosen = rules.expression("a.position.x == 1");
  engine::Enumeration by_face{.orbit = {0, 1}, .first = chosen.value.get(), .first_dart = chosen.dart};
  const engine::Candidates found = engine::candidates(matcher, *state, rule, {}, by_face);
  REQUIRE(found.darts.size() == 2);
  for (DartId d : found.darts) {
    CHECK(state->store.get(rules.embedding("position"), d)[0] == 1);
  }
  const auto never = rules.expression("a.position.x == 17");
  by_face.first = never.value.get();
  const engine::Candidates none = engine::candidates(matcher, *state, rule, {}, by_face);
  REQUIRE(none.error);
  CHECK(none.error->kind == support::DiagnosticKind::NoMatch);
}

TEST_CASE("only marked orbits, only wanted darts") {
  const RuleBook rules(kRules, 2);
  const auto state = make_state(rules.program(), gmap::grid(2, 1, 2.0, 1.0, gmap::GridCells::Quads));
  engine::Matcher matcher(*state);
  const compile::Rule& rule = rules.rule("edge");
  engine::Enumeration wanted{.orbit = {0, 1}, .presence = rules.embedding("mark")};
  CHECK(engine::candidates(matcher, *state, rule, {}, wanted).darts.empty());
  state->store.set(*wanted.presence, DartId{8}, std::vector<double>{1});
  CHECK(engine::candidates(matcher, *state, rule, {}, wanted).darts == std::vector{DartId{8}});
  wanted.where = [](DartId d) { return types::index(d) > 10; };
  CHECK(engine::candidates(matcher, *state, rule, {}, wanted).darts == std::vector{DartId{11}});
}

TEST_CASE("an error in a condition ends the enumeration") {
  const RuleBook rules(kRules, 2);
  const auto state = make_state(rules.program(), gmap::grid(2, 1, 2.0, 1.0, gmap::GridCells::Quads));
  state->map.unsew(1, DartId{8});
  engine::Matcher matcher(*state);
  const auto found = engine::candidates(matcher, *state, rules.rule("open"), {}, {.orbit = {0, 1}});
  REQUIRE(found.error);
  CHECK(found.error->kind == support::DiagnosticKind::OpenFace);
}
