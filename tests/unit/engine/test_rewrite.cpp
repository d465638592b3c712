// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "engine/enumerate.h"
#include "engine/rewrite.h"
#include "gmap/mesh_builders.h"
#include "gmap/validate.h"
#include "support/engine_rules.h"

using namespace gmsim;
using namespace gmsim::tests;
using engine::RewriteOutcome;
using support::DiagnosticKind;
using types::DartId;
using types::OrbitType;

namespace {

const char* const kRules = R"(
embedding position : vec3 on vertex merge mean;
embedding mass : real on <1> extensive;
embedding count : int on vertex merge max = 0;
rule separate(a) { left { a<0> -2- b<0>; } right { a -2- a; b -2- b; } }
rule sew(a, b) { left { a<0> -2- a; b<0> -2- b; } right { a -2- b; } }
rule delete_face(a) { left { a<0,1> -2- a; } right { } }
rule cut(a) {
  left { a<0,2>; } right { a<_,2> -0- m<1,2>; }
  m.position = 0.5 * (a.position + a@0.position);
  m.mass = 0.25 * (a.mass + a@0.mass);
  a.mass = 0.5 * a.mass;
}
rule corner() { left { } right { a -0- a; a -1- a; a -2- a; } a.position = (1, 2, 3); a.mass = 4; }
rule divide(a) { left { a; } a.position = a.position / (a.position.x - a.position.x); where true; }
rule lift(a) { left { a<1,2>; } param by : real; a.position = a.position + by * (0, 0, 1); }
rule swap_ends(a) { left { a<0>; } a.position = a@0.position; }
rule tell(a) { left { a -0- b; } b.count = a.count + 1; }
rule cone(a) {
  left { a<0,1>; } right { a<0,_> -1- b<_,2> -0- c<1,2>; }
  c.position = mean(x in face(a) / vertex : x.position);
  c.mass = 0;
}
)";

struct Fixture {
  RuleBook rules{kRules, 2};
  std::unique_ptr<engine::State> state =
      make_state(rules.program(), gmap::grid(2, 1, 2.0, 1.0, gmap::GridCells::Quads));
  engine::Rewriter rewriter{*state, {.validate = true}};

  RewriteOutcome apply(const char* rule, std::vector<DartId> hooks,
                       const engine::Arguments& given = {}) {
    return rewriter.apply(rules.rule(rule), hooks, given);
  }
  DartId inner() const {
    std::uint32_t d = 0;
    while (state->map.is_free(2, DartId{d})) ++d;
    return DartId{d};
  }
  std::vector<double> value(const char* name, DartId d) const {
    const auto value = state->store.get(rules.embedding(name), d);
    return {value.begin(), value.end()};
  }
  void set(const char* name, DartId d, std::vector<double> value) {
    state->store.set(rules.embedding(name), d, value);
  }
};

}  // namespace

TEST_CASE("a cut copies intensive values and reports what it did") {
  Fixture f;
  const DartId a = f.inner(), b = f.state->map.alpha(2, a);
  const auto position = f.value("position", a);
  const RewriteOutcome outcome = f.apply("separate", {a});
  REQUIRE(outcome.applied());
  CHECK(f.state->map.is_free(2, a));
  CHECK(f.value("position", a) == position);
  CHECK(f.value("position", b) == position);
  CHECK(outcome.effects.touched.size() == 4);
  CHECK(outcome.effects.applications == 1);
  CHECK(outcome.effects.matched_rows == 2);
  const gmap::OrbitRepair* vertices = outcome.effects.find({1, 2});
  REQUIRE(vertices != nullptr);
  CHECK(vertices->split == 2);
  CHECK(vertices->orbits.size() == 4);
  CHECK(outcome.effects.find({1}) == nullptr);  // corners hold no 2-link
  CHECK(!f.apply("separate", {a}).applied());
}

TEST_CASE("values that the merged orbits agree on stay exactly, others follow the policy") {
  Fixture f;
  const DartId a = f.inner(), b = f.state->map.alpha(2, a), c = f.state->map.alpha(0, b);
  REQUIRE(f.apply("separate", {a}).applied());
  const auto far = f.value("position", c);
  f.set("position", a, {0.1, 0.2, 0.3});
  f.set("position", b, {0.3, 0.4, 0.5});
  f.set("count", b, {5});
  const RewriteOutcome outcome = f.apply("sew", {a, b});
  REQUIRE(outcome.applied());
  CHECK(f.value("position", a) ==
        std::vector<double>{(0.1 + 0.3) / 2, (0.2 + 0.4) / 2, (0.3 + 0.5) / 2});
  CHECK(f.value("position", c) == far);
  CHECK(f.value("count", a) == std::vector<double>{5});
  CHECK(outcome.effects.find({1, 2})->merged == 2);
}

TEST_CASE("assigned values are computed on the old map, once for each orbit that the rule makes") {
  Fixture f;
  const DartId a{0}, b = f.state->map.alpha(0, a);
  f.set("mass", a, {8});
  f.set("mass", b, {4});
  REQUIRE(f.apply("cut", {a}).applied());
  const DartId m = f.state->map.alpha(0, a);
  CHECK(f.value("mass", a) == std::vector<double>{4});
  CHECK(f.value("mass", b) == std::vector<double>{2});
  CHECK(f.value("mass", m) == std::vector<double>{3});
  CHECK(f.value("position", m) == std::vector<double>{0.5, 0, 0});
  CHECK(f.state->map.dart_count() == 18);
}

TEST_CASE("rules without hooks create, rules without right nodes delete") {
  Fixture f;
  const RewriteOutcome created = f.apply("corner", {});
  REQUIRE(created.applied());
  CHECK(created.effects.created_darts == 1);
  CHECK(f.value("position", DartId{16}) == std::vector<double>{1, 2, 3});
  const RewriteOutcome refused = f.apply("delete_face", {DartId{0}});
  CHECK(refused.status == RewriteOutcome::Status::NotMatched);
  REQUIRE(f.apply("separate", {f.inner()}).applied());
  const RewriteOutcome deleted = f.apply("delete_face", {DartId{0}});
  REQUIRE(deleted.applied());
  CHECK(deleted.effects.removed_darts == 8);
  CHECK(deleted.effects.find({1, 2})->removed.size() == 4);
  CHECK(!f.state->map.alive(DartId{0}));
}

TEST_CASE("a refusal names rule, darts and reason") {
  Fixture f;
  const RewriteOutcome outcome = f.apply("separate", {DartId{0}});
  REQUIRE(outcome.status == RewriteOutcome::Status::NotMatched);
  const DartId hook{0};
  const auto told = engine::not_matched(f.rules.rule("separate"), {&hook, 1}, outcome.failure);
  CHECK(told.kind == DiagnosticKind::NoMatch);
  CHECK(told.message ==
        "rule `separate` cannot be applied at a = dart 0: there is no link `a -2- b`");
  CHECK(f.rules.rendered(told).find("test.rule") != std::string::npos);
}

TEST_CASE("a value that is no number is never stored") {
  Fixture f;
  const std::string before = fingerprint(*f.state);
  const RewriteOutcome outcome = f.apply("divide", {DartId{0}});
  REQUIRE(outcome.status == RewriteOutcome::Status::Failed);
  CHECK(outcome.error->kind == DiagnosticKind::NonFinite);
  CHECK(outcome.error->notes.back() == "applying rule `divide` at a = dart 0");
  CHECK(fingerprint(*f.state) == before);
}

TEST_CASE("parameters without default must be given") {
  Fixture f;
  CHECK(f.apply("lift", {DartId{0}}).error->kind == DiagnosticKind::ArgumentCount);
  const types::Slot by = f.rules.rule("lift").find_parameter("by")->slot;
  REQUIRE(f.apply("lift", {DartId{0}}, {{by, types::Value::real(2)}}).applied());
  CHECK(f.value("position", DartId{0}) == std::vector<double>{0, 0, 2});
}

TEST_CASE("a rule is applied at one candidate after the other, each matched again") {
  Fixture f;
  const compile::Rule& rule = f.rules.rule("separate");
  const engine::Candidates found =
      engine::candidates(f.rewriter.matcher(), *f.state, rule, {}, {.orbit = {0}});
  REQUIRE(found.darts.size() == 2);  // both sides of the inner edge
  const RewriteOutcome outcome = f.rewriter.apply_each(rule, found.darts);
  REQUIRE(outcome.applied());
  CHECK(outcome.effects.applications == 1);
  CHECK(outcome.effects.dropped == 1);
}

TEST_CASE("rules that change values only read the old state everywhere") {
  Fixture f;
  const DartId a{0}, b = f.state->map.alpha(0, a);
  const auto at_a = f.value("position", a), at_b = f.value("position", b);
  REQUIRE(f.apply("swap_ends", {a}).applied());
  CHECK(f.value("position", a) == at_b);
  CHECK(f.value("position", b) == at_a);
}

TEST_CASE("at once, all matches read before any writes, and may not disagree") {
  Fixture f;
  const compile::Rule& rule = f.rules.rule("tell");
  std::vector<DartId> all;
  for (std::uint32_t d = 0; d < 16; ++d) all.push_back(DartId{d});
  for (DartId d : all) f.set("count", d, {4});
  const RewriteOutcome outcome = f.rewriter.apply_at_once(rule, all);
  REQUIRE(outcome.status == RewriteOutcome::Status::Applied);
  CHECK(outcome.effects.applications == 16);
  for (DartId d : all) CHECK(f.value("count", d) == std::vector<double>{5});

  f.set("count", DartId{0}, {7});
  const std::string before = fingerprint(*f.state);
  const RewriteOutcome conflict = f.rewriter.apply_at_once(rule, all);
  REQUIRE(conflict.status == RewriteOutcome::Status::Failed);
  CHECK(conflict.error->kind == DiagnosticKind::ConflictingValues);
  CHECK(fingerprint(*f.state) == before);
}

TEST_CASE("several applications are undone together") {
  Fixture f;
  const std::string before = fingerprint(*f.state);
  f.rewriter.begin();
  REQUIRE(f.apply("separate", {f.inner()}).applied());
  REQUIRE(f.apply("delete_face", {DartId{8}}).applied());
  REQUIRE(f.apply("cone", {DartId{0}}).applied());
  REQUIRE(f.apply("corner", {}).applied());
  f.rewriter.set_value(f.rules.embedding("count"), DartId{0}, std::vector<double>{9});
  CHECK(fingerprint(*f.state) != before);
  f.rewriter.roll_back();
  CHECK(fingerprint(*f.state) == before);
  CHECK(gmap::validate(f.state->map, f.state->store).empty());
  REQUIRE(f.apply("separate", {f.inner()}).applied());
}

TEST_CASE("embeddings that are not in use cost nothing and are not asked for") {
  const RuleBook rules(kRules, 2);
  engine::State state(rules.program(),
                      gmap::build_map(gmap::grid(2, 1, 2.0, 1.0, gmap::GridCells::Quads)).map);
  engine::Rewriter rewriter(state, {.validate = true});
  const DartId a{0};
  REQUIRE(rewriter.apply(rules.rule("cut"), {&a, 1}).applied());
  CHECK(state.store.embeddings().empty());
}
