// SPDX-License-Identifier: MIT
// Expressions: types, units and constants, in the notation of checked expressions.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "check_text.h"

namespace {

using gmsim::check_tests::check_text;
using gmsim::check_tests::checked_expression;

struct Row {
  std::string text;
  std::string checked;
};

const std::string kRules = R"(
embedding gap : real [mm] on vertex = 0;
embedding table : vec3[4][8] on vertex = 0;
embedding tag : int on vertex optional;
embedding stress : sym3 [Pa] on vertex = 0;
embedding frame : mat3 on vertex = 0;
interaction one on halfedge(a) { match a -0- b; param stiffness : real [N/m]; result push : real [N] = 1;
  force a on dart = (0, 0, 0); }
interaction two on halfedge(a) { match a -2- b; param stiffness : real [N/m]; result push : real [N] = 2;
  force a on dart = (0, 0, 0); }
family both = one, two;
)";

void check_rows(const std::vector<Row>& rows) {
  const auto rules = check_text(kRules);
  REQUIRE(rules.messages() == "");
  for (const Row& row : rows) {
    CAPTURE(row.text);
    CHECK(checked_expression(rules, 2, row.text) == row.checked);
  }
}

}  // namespace

TEST_CASE("bare numbers are dimensionless in products and take a unit elsewhere") {
  check_rows({
      {"2 * a.mass", "2 * a.mass : real [kg]"},
      {"a.mass + 2", "a.mass + 2 : real [kg]"},
      {"1 + 2 * 3", "7 : int"},
      {"1 / 2", "0.5 : real"},
      {"2 ^ 3", "8 : int"},
      {"0.5 [km]", "500 : real [m]"},
      {"(1, 2, 3) [cm]", "(0.01, 0.02, 0.03) : vec3 [m]"},
      {"(1 [m], 2, 3)", "(1, 2, 3) : vec3 [m]"},
      {"30 [deg] < 1", "true : bool"},
      {"a.gap + 5", "a.gap + 0.005 : real [m]"},
      {"2 * a.gap + 5", "2 * a.gap + 5 : real [m]"},
      {"a.gap > 5 [m]", "a.gap > 5 : bool"},
      {"0 + a.position", "(0, 0, 0) + a.position : vec3 [m]"},
      {"sqrt(2) + a.mass", "sqrt(2) + a.mass : real [kg]"},
      {"time > 3", "time > 3 : bool"},
      {"step / 2 * dt", "step / 2 * dt : real [s]"},
  });
}

TEST_CASE("units follow the operations") {
  check_rows({
      {"norm(a.position)", "norm(a.position) : real [m]"},
      {"normalize(a.position)", "normalize(a.position) : vec3 [1]"},
      {"cross(a.position, a.velocity)", "cross(a.position, a.velocity) : vec3 [m^2/s]"},
      {"a.mass ^ 0.5", "a.mass^0.5 : real [kg^(1/2)]"},
      {"sqrt(a.mass) * sqrt(a.mass)", "sqrt(a.mass) * sqrt(a.mass) : real [kg]"},
      {"atan2(a.mass, a.mass)", "atan2(a.mass, a.mass) : real [1]"},
      {"det(a.frame)", "det(a.frame) : real"},
      {"max_eigenpair(a.stress).value", "max_eigenpair(a.stress).value : real [Pa]"},
      {"max_eigenpair(a.stress).vector", "max_eigenpair(a.stress).vector : vec3 [1]"},
      {"grad(a.mass * norm(a.position), a.position)",
       "grad(a.mass * norm(a.position), a.position) : vec3 [kg]"},
      {"force_on(vertex(a))", "force_on(<1,2>(a)) : vec3 [N]"},
      {"sum(f in forces(vertex(a)) : norm(f))", "sum(f in forces(<1,2>(a)) : norm(f)) : real [N]"},
      {"count(x in vertex(a))", "count(x in <1,2>(a)) : int [1]"},
      {"random(7, face(a))", "random(7, <0,1>(a)) : real [1]"},
  });
}

TEST_CASE("ints become real where a real is asked for") {
  check_rows({
      {"a.tag + 0.5", "a.tag + 0.5 : real"},
      {"a.tag + 1", "a.tag + 1 : int"},
      {"a.tag * a.position", "a.tag * a.position : vec3"},
      {"mean(x in vertex(a) : x.tag)", "mean(x in <1,2>(a) : x.tag) : real"},
      {"max(a.tag, 2)", "max(a.tag, 2) : int"},
      {"max(a.tag, 2.5)", "max(a.tag, 2.5) : real"},
      {"sum(i in 0..3 : a.table[i][2])", "sum(i in 0..3 : a.table[i][2]) : vec3"},
      {"a.stress * a.position", "a.stress * a.position : vec3 [N/m]"},
      {"a.frame * a.stress", "a.frame * mat(a.stress) : mat3"},
  });
}

TEST_CASE("in a scene a bare embedding is read at the dart at hand") {
  check_rows({
      {"position.y > 0.999 and (position.x < 0.001 or position.x > 0.999)",
       "a.position.y > 0.999 and (a.position.x < 0.001 or a.position.x > 0.999) : bool"},
      {"1.5 * position", "1.5 * a.position : vec3 [m]"},
      {"one.stiffness", "a.one.stiffness : real [N/m]"},
      {"has(one)", "has(a.one) : bool"},
      {"has(tag)", "has(a.tag) : bool"},
      {"max(x in all vertex : -x.position.z)", "max(x in all <1,2> : -x.position.z) : real [m]"},
      {"q", "error: nothing is named `q` here"},
      {"count(x in all volume)", "error: there is no orbit `volume` in dimension 2"},
      {"vertex(a)", "<1,2>(a) : darts"},
  });
}

TEST_CASE("a family stands for the member that an orbit carries") {
  check_rows({
      {"a.both.push", "if has(a.one) then a.one.push else a.two.push : real [N]"},
      {"has(a.both)", "has(a.one) or has(a.two) : bool"},
      {"force_on(vertex(a), both)",
       "force_on(<1,2>(a), one) + force_on(<1,2>(a), two) : vec3 [N]"},
      {"a.both.pull", "error: interaction `two` has no parameter or result `pull`"},
      {"a.both", "error: `both` is a family, not a value"},
  });
}

TEST_CASE("darts are compared, walked and chosen") {
  check_rows({
      {"a@0@1 == a", "a@0@1 == a : bool"},
      {"a@0 != a", "not a@0 == a : bool"},
      {"(if free(a, 2) then a else a@2).mass",
       "(if free(a, 2) then a else a@2).mass : real [kg]"},
      {"argmax(x in vertex(a) : x.mass : x).mass",
       "argmax(x in <1,2>(a) : x.mass : x).mass : real [kg]"},
      {"count(x in <2>(a) / dart)", "count(x in <2>(a) / <>) : int [1]"},
      {"any(x in polygon(a) : free(x, n))", "any(x in polygon(a) : free(x, 2)) : bool"},
      {"free(a, n - 1)", "free(a, 1) : bool"},
      {"free(a, n + 1)", "error: there is no link 3 in dimension 2"},
  });
}

TEST_CASE("a wanted type and unit are asked for") {
  auto rules = check_text(kRules);
  const auto messages = [&](const std::string& text, const gmsim::check::WantedValue& wanted) {
    gmsim::support::Diagnostics diagnostics;
    const auto checked = gmsim::check::check_value_expression(
        rules.rules, 2, rules.sources.add("e", text), wanted, rules.sources, diagnostics);
    CHECK((checked.value == nullptr) == diagnostics.has_errors());
    return diagnostics.all().empty() ? "" : diagnostics.all()[0].message;
  };
  using gmsim::types::ValueKind;
  const auto newtons = gmsim::types::named_unit("N")->unit;
  CHECK(messages("3", {.type = {ValueKind::Real}, .unit = newtons}) == "");
  CHECK(messages("3 [N]", {.type = {ValueKind::Real}, .unit = newtons}) == "");
  CHECK(messages("mass", {.type = {ValueKind::Real}, .unit = newtons}) ==
        "the value is in [N], this is in [kg]");
  CHECK(messages("mass", {.type = {ValueKind::Bool}}) == "the value must be bool, this is real");
  CHECK(messages("mass +", {.type = {ValueKind::Real}}) != "");
}

TEST_CASE("text of any size ends") {
  std::string doubling = "function f0(x) = x + x;";
  for (int i = 1; i < 40; ++i)
    doubling += "function f" + std::to_string(i) + "(x) = f" + std::to_string(i - 1) + "(x) + f" +
                std::to_string(i - 1) + "(x);";
  const auto wide = check_text(doubling + "rule r(a) { left { a; } where f39(a.mass) > 0; }");
  CHECK(wide.diagnostics.has_errors());
  std::string chain = "function g0(x) = x;";
  for (int i = 1; i < 300; ++i)
    chain = "function g" + std::to_string(i) + "(x) = g" + std::to_string(i - 1) + "(x);" + chain;
  CHECK(check_text(chain).diagnostics.has_errors());
  std::string patterns = "pattern p0(a, b) { a -0- b; }";
  for (int i = 1; i < 40; ++i)
    patterns += "pattern p" + std::to_string(i) + "(a, b) { p" + std::to_string(i - 1) +
                "(a, b); p" + std::to_string(i - 1) + "(b, a); }";
  CHECK(check_text(patterns + "rule r(a) { left { p39(a, b); } }").diagnostics.has_errors());
}
