// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "engine/matcher.h"
#include "gmap/mesh_builders.h"
#include "support/engine_rules.h"

using namespace gmsim;
using namespace gmsim::tests;
using engine::MatchFailure;
using types::DartId;

namespace {

const char* const kRules = R"(
embedding position : vec3 [m] on vertex merge mean;
embedding note : real on face optional;
rule separate(a) { left { a<0> -2- b<0>; } right { a -2- a; b -2- b; } }
rule sew(a, b) { left { a<0> -2- a; b<0> -2- b; } right { a -2- b; } }
rule same_faces(a, b) { left { a<0,1>; b<0,1>; } }
rule high(a) { left { a<0,1>; } param limit : real = 1; let y = a.position.y; where y > limit; }
rule noted(a) { left { a; } where a.note > 0; }
rule pentagon(a) { left { a; } where sum(x in polygon(a) : 1) == 5; }
rule across(a) { left { p -0.1- a -2- b -1.0- q; } }
)";

/// Two unit squares side by side, dart 0 at the point (0, 0, 0).
struct Fixture {
  RuleBook rules{kRules, 2};
  std::unique_ptr<engine::State> state =
      make_state(rules.program(), gmap::grid(2, 1, 2.0, 1.0, gmap::GridCells::Quads));
  engine::Matcher matcher{*state};
  engine::Match match;

  bool matches(const char* rule, std::vector<DartId> hooks, const engine::Arguments& given = {}) {
    const compile::Rule& item = rules.rule(rule);
    engine::Frame frame(item.frame_size);
    for (const auto& [slot, value] : given) frame.set(slot, value);
    return matcher.match(item.match, hooks, frame, match);
  }
  MatchFailure::Reason reason() const { return matcher.failure().reason; }
  std::string told(const char* rule) const {
    return engine::describe(matcher.failure(), rules.rule(rule).match);
  }
  /// The smallest dart on the shared edge.
  DartId inner() const {
    std::uint32_t d = 0;
    while (state->map.is_free(2, DartId{d})) ++d;
    return DartId{d};
  }
};

}  // namespace

TEST_CASE("a match is a table of rows and columns") {
  Fixture f;
  const DartId a = f.inner();
  REQUIRE(f.matches("separate", {a}));
  CHECK(f.match.rows == 2);
  CHECK(f.match.dart(0, 0) == a);
  CHECK(f.match.dart(0, 1) == f.state->map.alpha(2, a));
  CHECK(f.match.dart(1, 0) == f.state->map.alpha(0, a));
  CHECK(f.match.next_row(0, 0) == 1);
  CHECK(f.match.next_row(1, 0) == 0);
}

TEST_CASE("failures say what is missing") {
  Fixture f;
  CHECK(!f.matches("separate", {DartId{0}}));
  CHECK(f.reason() == MatchFailure::Reason::Link);
  CHECK(f.told("separate") == "there is no link `a -2- b`");
  CHECK(!f.matches("sew", {f.inner(), DartId{0}}));
  CHECK(f.told("sew") == "there is no link `a -2- a`");
  CHECK(!f.matches("sew", {DartId{0}}));
  CHECK(f.reason() == MatchFailure::Reason::HookCount);
  CHECK(!f.matches("sew", {DartId{0}, DartId{0}}));
  CHECK(f.reason() == MatchFailure::Reason::NotDistinct);
  CHECK(!f.matches("separate", {DartId{4711}}));
  CHECK(f.reason() == MatchFailure::Reason::DeadHook);
}

TEST_CASE("hooks of different shape do not match together") {
  Fixture f;
  CHECK(f.matches("same_faces", {DartId{0}, DartId{8}}));
  CHECK(f.match.rows == 8);
  f.state->map.unsew(1, DartId{8});
  CHECK(!f.matches("same_faces", {DartId{0}, DartId{8}}));
  CHECK(f.reason() == MatchFailure::Reason::HookLabels);
}

TEST_CASE("conditions use parameters, given or by default") {
  Fixture f;
  const DartId low{0};
  CHECK(!f.matches("high", {low}));
  CHECK(f.reason() == MatchFailure::Reason::Where);
  const types::Slot limit = f.rules.rule("high").find_parameter("limit")->slot;
  CHECK(f.matches("high", {low}, {{limit, types::Value::real(-1)}}));
}

TEST_CASE("a condition on a missing optional value does not hold and is no error") {
  Fixture f;
  CHECK(!f.matches("noted", {DartId{0}}));
  CHECK(f.reason() == MatchFailure::Reason::Missing);
  f.state->store.set(f.rules.embedding("note"), DartId{0}, std::vector<double>{1});
  CHECK(f.matches("noted", {DartId{0}}));
}

TEST_CASE("a condition without a value is an error") {
  Fixture f;
  CHECK(!f.matches("pentagon", {DartId{0}}));
  CHECK(f.reason() == MatchFailure::Reason::Where);
  f.state->map.unsew(1, DartId{0});
  CHECK(!f.matches("pentagon", {DartId{0}}));
  CHECK(f.reason() == MatchFailure::Reason::Error);
  CHECK(f.matcher.failure().error->kind == support::DiagnosticKind::OpenFace);
}

TEST_CASE("paths walk over unnamed darts both ways") {
  Fixture f;
  const DartId a = f.inner();
  REQUIRE(f.matches("across", {a}));
  const gmap::GMap& map = f.state->map;
  const auto column = [&](const char* name) {
    const auto& nodes = f.rules.rule("across").match.nodes;
    std::uint32_t c = 0;
    while (nodes[c].name != name) ++c;
    return f.match.dart(0, c);
  };
  CHECK(column("p") == map.alpha(0, map.alpha(1, a)));
  CHECK(column("q") == map.alpha(0, map.alpha(1, map.alpha(2, a))));
}
