// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "engine/operation.h"
#include "gmap/mesh_builders.h"
#include "gmap/orbit_walk.h"
#include "gmap/validate.h"
#include "support/engine_rules.h"

using namespace gmsim;
using namespace gmsim::tests;
using engine::RewriteOutcome;
using support::DiagnosticKind;
using types::DartId;

namespace {

const char* const kRules = R"(
embedding position : vec3 [m] on vertex merge mean;
embedding level : int on face merge max = 0;
embedding note : real on face optional;
rule separate(a) { left { a<0> -2- b<0>; } right { a -2- a; b -2- b; } }
rule delete_face(a) { left { a<0,1> -2- a; } right { } }
rule raise(a) { left { a<0,1>; } param by : int = 1; a.level = a.level + by; }
operation remove on element(a) {
  for x in element(a) / facet where not free(x, 2) { apply separate(x); }
  apply delete_face(a);
}
operation remove_two on dart(a) { let b = a@0@1@2; apply remove(a); apply remove(b); }
operation cut_open on face(a) { apply separate(a); apply separate(a@0@1); }
operation levels on face(a) {
  param by : int = 2;
  let old = a.level;
  apply raise(a; by = by);
  if a.level > 3 { a.level = old; } else { apply raise(a); }
}
operation read_note on face(a) { let x = a.note; a.level = 1; }
operation once on vertex(a) {
  for x in vertex(a) / face where x.level == 0 {
    for y in all face { y.level = 1; }
    x.level = 5;
  }
}
operation count on face(a) { for i in 0..3 { a.level = a.level + i; } }
operation forever on face(a) { apply forever2(a); }
operation forever2 on face(a) { a.level = 1; }
)";

struct Fixture {
  RuleBook rules{kRules, 2};
  std::unique_ptr<engine::State> state =
      make_state(rules.program(), gmap::grid(3, 1, 3.0, 1.0, gmap::GridCells::Quads));
  engine::Rewriter rewriter{*state, {.validate = true}};
  engine::OperationRunner runner{rewriter};

  Fixture() {
    for (std::uint32_t d = 0; d < state->map.dart_end(); ++d) set_level(DartId{d}, 0);
  }
  RewriteOutcome run(const char* operation, DartId d, const engine::Arguments& given = {}) {
    return runner.run(rules.operation(operation), d, given);
  }
  double level(DartId d) const { return state->store.get(rules.embedding("level"), d)[0]; }
  void set_level(DartId d, double x) {
    state->store.set(rules.embedding("level"), d, std::vector<double>{x});
  }
};

}  // namespace

TEST_CASE("an operation cuts an element out and deletes it") {
  Fixture f;
  const RewriteOutcome outcome = f.run("remove", DartId{8});
  REQUIRE(outcome.applied());
  CHECK(outcome.effects.applications == 3);
  CHECK(outcome.effects.removed_darts == 8);
  CHECK(gmap::all_orbits(f.state->map, {0, 1}).size() == 2);
  CHECK(gmap::all_orbits(f.state->map, {0, 1, 2}).size() == 2);
  CHECK(gmap::validate(f.state->map, f.state->store).empty());
}

TEST_CASE("all or nothing: what was applied before a rule that does not match is undone") {
  Fixture f;
  const std::string before = fingerprint(*f.state);
  // The middle square: the cut on the one side applies, then there is no link to cut.
  DartId d{8};
  while (f.state->map.is_free(2, d)) d = DartId{types::index(d) + 1};
  const RewriteOutcome outcome = f.run("cut_open", d);
  REQUIRE(outcome.status == RewriteOutcome::Status::NotMatched);
  REQUIRE(outcome.error);
  CHECK(outcome.error->kind == DiagnosticKind::NoMatch);
  CHECK(outcome.error->message.find("rule `separate`") != std::string::npos);
  CHECK(outcome.error->notes.back().find("running operation `cut_open`") == 0);
  CHECK(outcome.effects.applications == 0);
  CHECK(fingerprint(*f.state) == before);
}

TEST_CASE("a nested operation that fails undoes the outer one") {
  Fixture f;
  const std::string before = fingerprint(*f.state);
  // The next edge is free, so b is a dart of the same face, gone by then.
  DartId d{8};
  while (!f.state->map.is_free(2, f.state->map.alpha(1, f.state->map.alpha(0, d)))) {
    d = DartId{types::index(d) + 1};
  }
  const RewriteOutcome outcome = f.run("remove_two", d);
  CHECK(outcome.status == RewriteOutcome::Status::NotMatched);
  CHECK(fingerprint(*f.state) == before);
}

TEST_CASE("lets keep values, parameters have defaults or are given") {
  Fixture f;
  const DartId a{0};
  REQUIRE(f.run("levels", a).applied());
  CHECK(f.level(a) == 3);
  REQUIRE(f.run("levels", a).applied());
  CHECK(f.level(a) == 3);  // 5 is above the limit
  f.set_level(a, 0);
  const types::Slot by = f.rules.operation("levels").find_parameter("by")->slot;
  REQUIRE(f.run("levels", a, {{by, types::Value::integer(1)}}).applied());
  CHECK(f.level(a) == 2);
}

TEST_CASE("a missing optional value makes an operation not apply") {
  Fixture f;
  const RewriteOutcome outcome = f.run("read_note", DartId{0});
  CHECK(outcome.status == RewriteOutcome::Status::NotMatched);
  CHECK(outcome.failure.reason == engine::MatchFailure::Reason::Missing);
  CHECK(f.level(DartId{0}) == 0);
}

TEST_CASE("each pass of a for judges its condition again") {
  Fixture f;
  // Two faces at the vertex are chosen; the first pass makes the second one's condition false.
  DartId d{8};
  while (f.state->map.is_free(2, d)) d = DartId{types::index(d) + 1};
  REQUIRE(f.run("once", d).applied());
  int raised = 0;
  for (DartId face : gmap::all_orbits(f.state->map, {0, 1})) raised += f.level(face) == 5;
  CHECK(raised == 1);
}

TEST_CASE("a for over numbers") {
  Fixture f;
  REQUIRE(f.run("count", DartId{0}).applied());
  CHECK(f.level(DartId{0}) == 3);
}

TEST_CASE("each run by itself, those that do not apply are counted") {
  Fixture f;
  const std::vector<DartId> darts{DartId{0}, DartId{8}, DartId{0}};
  const RewriteOutcome outcome = f.runner.run_each(f.rules.operation("remove"), darts);
  REQUIRE(outcome.applied());
  CHECK(outcome.effects.dropped == 1);
  CHECK(outcome.effects.removed_darts == 16);
}
