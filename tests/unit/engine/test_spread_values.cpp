// SPDX-License-Identifier: MIT
// Values after a rewrite: splits, merges, shares, defaults and conflicts.
#include <doctest/doctest.h>

#include <cmath>

#include "engine/rewrite.h"
#include "gmap/mesh_builders.h"
#include "gmap/orbit_walk.h"
#include "support/engine_rules.h"

using namespace gmsim;
using namespace gmsim::tests;
using engine::RewriteOutcome;
using support::DiagnosticKind;
using types::DartId;
using types::OrbitType;

namespace {

const char* const kSeparate =
    "rule separate(a) { left { a<0> -2- b<0>; } right { a -2- a; b -2- b; } }\n";
const char* const kSew =
    "rule sew(a, b) { left { a<0> -2- a; b<0> -2- b; } right { a -2- b; } }\n";

gmap::Mesh two_squares() { return gmap::grid(2, 1, 2.0, 1.0, gmap::GridCells::Quads); }

DartId inner_dart(const engine::State& state) {
  std::uint32_t d = 0;
  while (state.map.is_free(2, DartId{d})) ++d;
  return DartId{d};
}

double value(const engine::State& state, const RuleBook& rules, const char* name, DartId d) {
  const auto value = state.store.get(rules.embedding(name), d);
  return value.empty() ? NAN : value[0];
}

/// Two squares cut apart along their edge, with `x` on the vertices: 1 and 3 on one side, 2 and 8
/// on the other.
struct Apart {
  explicit Apart(const std::string& declaration)
      : rules(declaration + kSeparate + kSew, 2), state(make_state(rules.program(), two_squares())),
        rewriter(*state, {.validate = true}) {
    a = inner_dart(*state);
    b = state->map.alpha(2, a);
    REQUIRE(rewriter.apply(rules.rule("separate"), {&a, 1}).applied());
    set(a, 1);
    set(state->map.alpha(0, a), 3);
    set(b, 2);
    set(state->map.alpha(0, b), 8);
  }
  void set(DartId d, double x) {
    state->store.set(rules.embedding("x"), d, std::vector<double>{x});
  }
  RewriteOutcome sew() {
    const std::vector<DartId> hooks{a, b};
    return rewriter.apply(rules.rule("sew"), hooks);
  }
  double at(DartId d) const { return value(*state, rules, "x", d); }

  RuleBook rules;
  std::unique_ptr<engine::State> state;
  engine::Rewriter rewriter;
  DartId a, b;
};

}  // namespace

TEST_CASE("merge policies") {
  struct Case {
    const char* policy;
    double here, there;
  };
  for (const Case& c : {Case{"mean", 1.5, 5.5}, Case{"min", 1, 3}, Case{"max", 2, 8},
                        Case{"first", 1, 3}}) {
    CAPTURE(c.policy);
    Apart f("embedding x : real on vertex merge " + std::string(c.policy) + ";\n");
    REQUIRE(f.sew().applied());
    CHECK(f.at(f.a) == c.here);
    CHECK(f.at(f.b) == c.here);
    CHECK(f.at(f.state->map.alpha(0, f.b)) == c.there);
  }
}

TEST_CASE("merge equal demands equal values") {
  Apart f("embedding x : real on vertex merge equal;\n");
  const std::string before = fingerprint(*f.state);
  const RewriteOutcome outcome = f.sew();
  REQUIRE(outcome.status == RewriteOutcome::Status::Failed);
  CHECK(outcome.error->kind == DiagnosticKind::ConflictingValues);
  CHECK(outcome.error->message.find("1 and 2") != std::string::npos);
  CHECK(fingerprint(*f.state) == before);
  f.set(f.b, 1);
  f.set(f.state->map.alpha(0, f.b), 3);
  CHECK(f.sew().applied());
}

TEST_CASE("extensive values add up, and are divided over all parts at once") {
  Apart f("embedding x : real on vertex extensive;\n");
  REQUIRE(f.sew().applied());
  CHECK(f.at(f.a) == 3);
  CHECK(f.at(f.state->map.alpha(0, f.a)) == 11);
  REQUIRE(f.rewriter.apply(f.rules.rule("separate"), {&f.a, 1}).applied());
  CHECK(f.at(f.a) == 1.5);
  CHECK(f.at(f.b) == 1.5);
}

TEST_CASE("the parts of a split share equally, however many there are") {
  const RuleBook rules(
      "embedding x : real on <0,1,2> extensive;\n"
      "rule apart(a) { left { a<0,1,2>; } right { a<0,_,_> -1- a; a -2- a; } }",
      2);
  const auto state = make_state(rules.program(), gmap::grid(1, 1, 1.0, 1.0, gmap::GridCells::Quads));
  state->store.set(rules.embedding("x"), DartId{0}, std::vector<double>{20});
  engine::Rewriter rewriter(*state, {.validate = true});
  const DartId a{0};
  REQUIRE(rewriter.apply(rules.rule("apart"), {&a, 1}).applied());
  for (std::uint32_t d = 0; d < 8; ++d) CHECK(value(*state, rules, "x", DartId{d}) == 5);
}

TEST_CASE("weights divide an extensive value by what the parts are on the new map") {
  const std::string text =
      "embedding position : vec3 on vertex merge mean;\n"
      "embedding x : real on <0,1> extensive split abs(sum(p in polygon(a) : cross(p.position, "
      "p@0.position)).z);\n"
      "rule halve(a) { left { a -0- b -1- c -0- d -1- e -0- f -1- g -0- h -1- a; }\n"
      "  right { a -0- b -1- c -0- d -1- p -0- q -1- a; e -0- f -1- g -0- h -1- r -0- s -1- e;\n"
      "          p -2- s; q -2- r; } }";
  const RuleBook rules(text, 2);
  const auto state = make_state(
      rules.program(),
      [] {
        gmap::Mesh mesh;
        mesh.points = {{0, 0, 0}, {4, 0, 0}, {3, 2, 0}, {0, 1, 0}};
        mesh.add_cell(gmap::Mesh::CellKind::Polygon, {0, 1, 2, 3});
        return mesh;
      }());
  state->store.set(rules.embedding("x"), DartId{0}, std::vector<double>{11});
  engine::Rewriter rewriter(*state, {.validate = true});
  const DartId a{0};
  REQUIRE(rewriter.apply(rules.rule("halve"), {&a, 1}).applied());
  // The diagonal leaves triangles of area 4 and 1.5 of the face of area 5.5.
  std::vector<double> parts;
  for (DartId face : gmap::all_orbits(state->map, {0, 1})) {
    parts.push_back(value(*state, rules, "x", face));
  }
  std::sort(parts.begin(), parts.end());
  REQUIRE(parts.size() == 2);
  CHECK(parts[0] == doctest::Approx(3).epsilon(1e-14));
  CHECK(parts[1] == doctest::Approx(8).epsilon(1e-14));
}

TEST_CASE("weights that leave nothing to divide by are an error") {
  Apart f(
      "embedding w : real on vertex merge max = 1;\n"
      "embedding x : real on vertex extensive split a.w;\n");
  REQUIRE(f.sew().applied());
  for (DartId d : gmap::all_orbits(f.state->map, {1, 2})) {
    f.state->store.set(f.rules.embedding("w"), d, std::vector<double>{0});
  }
  const std::string before = fingerprint(*f.state);
  const RewriteOutcome outcome = f.rewriter.apply(f.rules.rule("separate"), {&f.a, 1});
  REQUIRE(outcome.status == RewriteOutcome::Status::Failed);
  CHECK(outcome.error->kind == DiagnosticKind::NonFinite);
  CHECK(fingerprint(*f.state) == before);
}

TEST_CASE("optional values stay where they are, alone or joined") {
  Apart f("embedding x : real on vertex merge mean;\nembedding y : real on vertex optional merge mean;\n");
  const auto y = f.rules.embedding("y");
  f.state->store.set(y, f.a, std::vector<double>{5});
  REQUIRE(f.sew().applied());
  CHECK(value(*f.state, f.rules, "y", f.b) == 5);
  CHECK(f.state->store.get(y, f.state->map.alpha(0, f.b)).empty());
}

TEST_CASE("created orbits get the default") {
  const RuleBook rules(
      "embedding x : real on face = 2.5;\nembedding y : real on face optional;\n"
      "rule dart() { left { } right { a -0- a; a -1- a; a -2- a; } }",
      2);
  const auto state = make_state(rules.program(), two_squares());
  engine::Rewriter rewriter(*state, {.validate = true});
  REQUIRE(rewriter.apply(rules.rule("dart"), {}).applied());
  CHECK(value(*state, rules, "x", DartId{16}) == 2.5);
  CHECK(state->store.get(rules.embedding("y"), DartId{16}).empty());
}

TEST_CASE("two assignments that meet in one orbit must agree") {
  // Two darts of an edge: on most meshes different vertices, on a folded one the same.
  const RuleBook rules(
      "embedding x : real on vertex merge mean;\n"
      "rule name_ends(a) { left { a -0- b; } a.x = 1; b.x = 2; }\n"
      "rule same_ends(a) { left { a -0- b; } a.x = 1; b.x = 1; }",
      2);
  gmap::GMap map(2);
  map.add_darts(2);
  map.sew(0, DartId{0}, DartId{1});
  map.sew(1, DartId{0}, DartId{1});
  const auto state = make_state(rules.program(), std::move(map));
  engine::Rewriter rewriter(*state);
  const std::string before = fingerprint(*state);
  const DartId a{0};
  const RewriteOutcome outcome = rewriter.apply(rules.rule("name_ends"), {&a, 1});
  REQUIRE(outcome.status == RewriteOutcome::Status::Failed);
  CHECK(outcome.error->kind == DiagnosticKind::ConflictingValues);
  REQUIRE(outcome.error->related.size() == 1);
  CHECK(outcome.error->place != outcome.error->related[0].span);
  CHECK(fingerprint(*state) == before);
  CHECK(rewriter.apply(rules.rule("same_ends"), {&a, 1}).applied());
}

TEST_CASE("whoever owns an interaction is told of created orbits") {
  const RuleBook rules(
      "embedding position : vec3 [m] on vertex merge mean;\n"
      "interaction spring on halfedge(a) {\n"
      "  match a -0- b; param rest : real [m] = norm(b.position - a.position);\n"
      "  energy 1 [N/m] * (norm(b.position - a.position) - rest)^2; force a, b on dart; }\n"
      "rule cut(a) { left { a<0,2>; } right { a<_,2> -0- m<1,2>; }\n"
      "  m.position = 0.5 * (a.position + a@0.position); }\n"
      "rule cone(a) { left { a<0,1>; } right { a<0,_> -1- b<_,2> -0- c<1,2>; }\n"
      "  c.position = mean(x in face(a) / vertex : x.position); }",
      2);
  const auto state = make_state(rules.program(), two_squares());
  const types::EmbeddingId presence = *rules.program().interactions.at(0).presence;
  const types::EmbeddingId rest = rules.embedding("spring.rest");
  state->use(presence);
  state->use(rest);
  for (DartId d : gmap::all_orbits(state->map, {0})) {
    state->store.set(presence, d, std::vector<double>{1});
    state->store.set(rest, d, std::vector<double>{1});
  }
  engine::Rewriter rewriter(*state, {.validate = true});
  std::vector<DartId> created;
  rewriter.on_created([&](engine::Rewriter& self, types::EmbeddingId id, DartId smallest) {
    CHECK(id == presence);
    created.push_back(smallest);
    self.set_value(presence, smallest, std::vector<double>{1});
    self.set_value(rest, smallest, std::vector<double>{0.5});
    return std::optional<support::Diagnostic>{};
  });
  const std::string before = fingerprint(*state);
  const DartId a{0};
  rewriter.begin();
  REQUIRE(rewriter.apply(rules.rule("cut"), {&a, 1}).applied());
  CHECK(created.empty());  // the halves of an edge are parts of it
  const DartId half = state->map.alpha(0, a);
  CHECK(value(*state, rules, "spring.rest", half) == 1);
  REQUIRE(rewriter.apply(rules.rule("cone"), {&a, 1}).applied());
  CHECK(created.size() == 10);  // a face of five corners now: two half-edges to each
  for (DartId d : created) CHECK(value(*state, rules, "spring.rest", d) == 0.5);
  rewriter.roll_back();
  CHECK(fingerprint(*state) == before);
}
