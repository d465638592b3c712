// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <set>

#include "engine/tree_eval.h"
#include "gmap/mesh_builders.h"
#include "support/engine_rules.h"

using namespace gmsim;
using namespace gmsim::tests;
using types::DartId;

namespace {

const char* const kData = R"(
embedding position : vec3 [m] on vertex merge mean;
embedding corner_mass : real [kg] on corner extensive;
embedding note : real on face optional;
embedding table : real[3][2] on face = 0;
derived mass : real [kg] on vertex(v) = sum(c in vertex(v) / corner : c.corner_mass);
derived heavy : bool on vertex(v) = v.mass > 0.5;
function middle(a) = mean(x in element(a) / vertex : x.position);
)";

/// Four unit squares; dart 0 sits on the point (0, 0, 0).
struct Fixture {
  RuleBook rules{kData, 2};
  std::unique_ptr<engine::State> state =
      make_state(rules.program(), gmap::grid(2, 2, 2.0, 2.0, gmap::GridCells::Quads));
  std::vector<double> value(const std::string& text, std::uint32_t dart = 0) const {
    return evaluate(*state, rules.expression(text), DartId{dart}).data;
  }
  double number(const std::string& text, std::uint32_t dart = 0) const {
    return value(text, dart).at(0);
  }
  support::Diagnostic failure(const std::string& text, bool* optional = nullptr) const {
    const RuleBook::Expression expr = rules.expression(text);
    engine::TreeEvaluator evaluator(*state);
    engine::Frame frame(expr.frame_size);
    frame.set(expr.dart, DartId{0});
    REQUIRE(!evaluator.evaluate(*expr.value, frame));
    const engine::EvalFailure failure = evaluator.take_failure();
    CHECK(failure.diagnostic.place.has_value());
    if (optional != nullptr) *optional = failure.missing_optional;
    REQUIRE(!evaluator.failed());
    return failure.diagnostic;
  }
};

}  // namespace

TEST_CASE("arithmetic of numbers, vectors and matrices") {
  const Fixture f;
  CHECK(f.number("1 + 2 * 3 - 4 / 8") == 6.5);
  CHECK(f.number("2^3 - (-1)^2") == 7);
  CHECK(f.value("2 * (1, 2, 3) - (0, 0, 1) / 2") == std::vector<double>{2, 4, 5.5});
  CHECK(f.value("-(1, 2)") == std::vector<double>{-1, -2});
  CHECK(f.number("(1, 2, 3).y") == 2);
  CHECK(f.value("rows((1, 2, 3), (0, 1, 0), (0, 0, 2)) * (1, 1, 1)") ==
        std::vector<double>{6, 1, 2});
  CHECK(f.value("outer((1, 0, 0), (0, 1, 0)) * outer((0, 1, 0), (0, 0, 1))") ==
        std::vector<double>{0, 0, 1, 0, 0, 0, 0, 0, 0});
  CHECK(f.number("max_eigenpair(diagonal((1, 4, 2))).value") == 4);
  CHECK(f.value("max_eigenpair(diagonal((1, 4, 2))).vector") == std::vector<double>{0, 1, 0});
  CHECK(f.number("if 2 == 2 and not (1 > 2) then 5 else 6") == 5);
  CHECK(f.number("if 1 != 1 or 2 <= 1 then 5 else 6") == 6);
  CHECK(f.value("if true then (0, 0, 0) else (1, 1, 1)") == std::vector<double>{0, 0, 0});
}

TEST_CASE("walks, free links and dart equality") {
  const Fixture f;
  CHECK(f.number("a == a@0@0") == 1);
  CHECK(f.number("a == a@0") == 0);
  CHECK(f.number("free(a, 2)") == 1);
  CHECK(f.number("free(a@0@1, 2)") == 0);
  CHECK(f.value("a@0.position") == std::vector<double>{1, 0, 0});
}

TEST_CASE("folds run over collections") {
  const Fixture f;
  CHECK(f.number("count(x in all vertex)") == 9);
  CHECK(f.number("count(x in all vertex : x.position.x == 1)") == 3);
  CHECK(f.number("sum(x in all vertex : x.position.x)") == 9);
  CHECK(f.value("mean(x in all vertex : x.position)") == std::vector<double>{1, 1, 0});
  CHECK(f.value("middle(a)") == std::vector<double>{0.5, 0.5, 0});
  CHECK(f.number("max(x in all vertex : x.position.x + 10 * x.position.y)") == 22);
  CHECK(f.number("min(x in element(a) : -x.position.x)") == -1);
  CHECK(f.number("any(x in face(a) / vertex : x.position.y > 0.5)") == 1);
  CHECK(f.number("all(x in face(a) / vertex : x.position.y > 0.5)") == 0);
  CHECK(f.value("argmax(x in all vertex : x.position.x : x.position)") ==
        std::vector<double>{2, 0, 0});
  CHECK(f.value("argmin(x in all face : -middle(x).y : x@0).position").at(1) >= 0);
  CHECK(f.number("sum(i in 0..5 : i * i)") == 30);
  CHECK(f.number("argmax(i in 0..5 : i * (4 - i) : i)") == 2);
  CHECK(f.number("sum(i in 3..1 : i)") == 0);
  CHECK(f.number("count(x in polygon(a))") == 4);
  CHECK(f.value("0.5 * sum(x in polygon(a) : cross(x.position, x@0.position))") ==
        std::vector<double>{0, 0, 1});
}

TEST_CASE("a quotient counts whole orbits of its second type") {
  const Fixture f;
  CHECK(f.number("count(x in face(a) / vertex)") == 4);
  CHECK(f.number("count(x in face(a) / dart)") == 8);
  CHECK(f.number("count(x in component(a) / face)") == 4);
  // Both darts of a border edge and the others of the component share vertices outside of the face.
  CHECK(f.number("count(x in component(a) / vertex)") == 9);
  CHECK(f.number("all(x in component(a) / edge : x == argmin(y in edge(x) : 0 * y.position.x : y))") == 1);
}

TEST_CASE("quotients are the same with and without orbit indices") {
  const RuleBook rules("embedding value : real on dart = 1;", 2);
  const gmap::Mesh mesh = gmap::grid(3, 2, 1.0, 1.0, gmap::GridCells::Mix4);
  const auto plain = make_state(rules.program(), mesh);
  const auto indexed = make_state(rules.program(), mesh);
  for (unsigned bits = 0; bits < 8; ++bits) {
    indexed->store.use_index(types::OrbitType::from_bits(static_cast<std::uint8_t>(bits)));
  }
  for (const char* outer : {"face", "vertex", "edge", "component", "<0>", "<1>", "<2>"}) {
    for (const char* inner : {"vertex", "edge", "face", "corner", "<0>", "<2>", "dart"}) {
      const std::string text = std::string(outer) + "(a) / " + inner;
      CAPTURE(text);
      const auto expression = rules.expression(text);
      for (std::uint32_t d = 0; d < plain->map.dart_end(); d += 5) {
        CHECK(evaluate(*plain, expression, DartId{d}).darts ==
              evaluate(*indexed, expression, DartId{d}).darts);
      }
    }
  }
}

TEST_CASE("derived values follow what they read") {
  const Fixture f;
  const types::EmbeddingId corner_mass = f.rules.embedding("corner_mass");
  for (std::uint32_t d = 0; d < f.state->map.dart_end(); ++d) {
    f.state->store.set(corner_mass, DartId{d}, std::vector<double>{0.25});
  }
  CHECK(f.number("mass") == 0.25);
  CHECK(f.number("a@0.mass") == 0.5);
  CHECK(f.number("sum(v in all vertex : v.mass)") == 4);
  CHECK(f.number("heavy") == 0);
  CHECK(f.number("count(v in all vertex : v.heavy)") == 1);
  CHECK(f.number("has(a.mass)") == 1);
}

TEST_CASE("arrays are indexed and checked") {
  const Fixture f;
  f.state->store.set(f.rules.embedding("table"), DartId{0}, std::vector<double>{1, 2, 3, 4, 5, 6});
  CHECK(f.number("table[1][0]") == 3);
  CHECK(f.number("sum(i in 0..3 : sum(j in 0..2 : table[i][j]))") == 21);
  CHECK(f.value("table[2]") == std::vector<double>{5, 6});
  const support::Diagnostic failure = f.failure("table[count(x in face(a) / vertex) - 1][0]");
  CHECK(failure.kind == support::DiagnosticKind::BadIndex);
  CHECK(failure.message.find("3") != std::string::npos);
}

TEST_CASE("optional values are tested, and missed where they are not") {
  const Fixture f;
  CHECK(f.number("if has(a.note) then a.note else -1") == -1);
  bool optional = false;
  CHECK(f.failure("1 + a.note", &optional).kind ==
        support::DiagnosticKind::MissingEmbeddingValue);
  CHECK(optional);
  f.state->store.set(f.rules.embedding("note"), DartId{0}, std::vector<double>{3});
  CHECK(f.number("if has(a.note) then a.note else -1") == 3);
}

TEST_CASE("folds over nothing and open faces are errors") {
  const Fixture f;
  CHECK(f.failure("mean(i in 0..0 : i)").kind == support::DiagnosticKind::EmptyFold);
  CHECK(f.failure("max(i in 0..0 : i)").message.find("`max`") != std::string::npos);
  CHECK(f.failure("argmax(i in 0..0 : i : i)").kind == support::DiagnosticKind::EmptyFold);
  f.state->map.unsew(1, DartId{0});
  const support::Diagnostic failure = f.failure("count(x in polygon(a))");
  CHECK(failure.kind == support::DiagnosticKind::OpenFace);
  REQUIRE(failure.notes.size() == 1);
  CHECK(failure.notes[0].find("0, 1, 2, 3, 4, 5, 6, 7") != std::string::npos);
}

TEST_CASE("random numbers belong to orbits and seeds") {
  const Fixture f;
  const auto random = f.rules.expression("random(7, face(a))");
  const double here = evaluate(*f.state, random, DartId{0}).data[0];
  CHECK(here == evaluate(*f.state, random, DartId{5}).data[0]);
  CHECK(here != evaluate(*f.state, random, DartId{8}).data[0]);
  CHECK(here != f.number("random(8, face(a))"));
  CHECK(here != f.number("random(7, vertex(a))"));
  f.state->seed = 99;
  CHECK(here != f.number("random(7, face(a))"));
  double sum = 0.0;
  std::set<double> values;
  for (std::int64_t seed = 0; seed < 4000; ++seed) {
    const double x = engine::random_number(seed, *f.state, {0, 1}, DartId{0});
    REQUIRE(x >= 0.0);
    REQUIRE(x < 1.0);
    values.insert(x);
    sum += x;
  }
  CHECK(values.size() == 4000);
  CHECK(sum / 4000 == doctest::Approx(0.5).epsilon(0.03));
}

TEST_CASE("the clock") {
  const Fixture f;
  f.state->time = 1.5;
  f.state->dt = 0.25;
  f.state->step = 6;
  CHECK(f.number("time + dt") == 1.75);
  CHECK(f.number("step") == 6);
}

TEST_CASE("forces are not there outside of a simulation") {
  const Fixture f;
  CHECK(f.failure("norm(force_on(vertex(a)))").kind == support::DiagnosticKind::NotAvailable);
}

TEST_CASE("arguments of nested functions are evaluated once") {
  std::string text = kData;
  text += "function f0(x) = x + x;\n";
  constexpr int kLevels = 40;  // 2^40 evaluations if arguments were copied
  for (int k = 1; k <= kLevels; ++k) {
    text += "function f" + std::to_string(k) + "(x) = f" + std::to_string(k - 1) + "(x + x);\n";
  }
  const RuleBook rules(text, 2);
  const auto state = make_state(rules.program(), gmap::grid(1, 1, 1.0, 1.0, gmap::GridCells::Quads));
  CHECK(evaluate(*state, rules.expression("f40(1.0)"), DartId{0}).data[0] == 0x1p41);
}

TEST_CASE("sums run in ascending order of the smallest darts, whichever dart asks") {
  const Fixture f;
  const auto sum = f.rules.expression("sum(x in component(a) / vertex : norm(x.position + (0.1, 0.7, 0.3)))");
  const double here = evaluate(*f.state, sum, DartId{0}).data[0];
  for (std::uint32_t d = 0; d < f.state->map.dart_end(); ++d) {
    CHECK(evaluate(*f.state, sum, DartId{d}).data[0] == here);
  }
}
