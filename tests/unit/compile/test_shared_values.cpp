// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <map>

#include "check/make_expr.h"
#include "support/engine_rules.h"

using namespace gmsim;
using namespace gmsim::tests;
using types::Expr;
using types::ExprKind;

namespace {

/// How often each number stands on a fold and on a let of a rule's values.
struct Numbers {
  std::map<int, int> folds, lets;
};

Numbers numbers_of(const std::string& body, const std::string& functions = {}) {
  const RuleBook rules(R"(
embedding position : vec3 on vertex merge mean = (0, 0, 0);
embedding weight : real on <1> extensive = 0;
embedding other : real on <1> extensive = 0;
)" + functions + R"(
rule cone(a) {
  left  { a<0,1>; }
  right { a<0,_> -1- b<_,2> -0- c<1,2>; }
)" + body + "\n}\n",
                       2);
  Numbers numbers;
  for (const compile::Assignment& assignment : rules.rule("cone").rewrite.assignments) {
    check::for_each_node(assignment.value, [&](const Expr& node) {
      if (node.number == 0) return;
      if (node.kind == ExprKind::Fold) ++numbers.folds[node.number];
      if (node.kind == ExprKind::Let) ++numbers.lets[node.number];
    });
  }
  return numbers;
}

}  // namespace

TEST_CASE("a fold that is evaluated once is not kept") {
  const Numbers numbers = numbers_of("c.position = mean(x in <0,1>(a) / <1,2> : x.position);");
  CHECK(numbers.folds.empty());
  CHECK(numbers.lets.empty());
}

TEST_CASE("a fold over an orbit is kept when several rows of the orbit ask for it") {
  const Numbers numbers = numbers_of("a.weight = sum(x in <0,1>(a) / <1> : x.weight);");
  CHECK(numbers.folds.size() == 1);
  CHECK(numbers.lets.empty());
}

TEST_CASE("names of locals do not matter, orbits, kinds and terms do") {
  const Numbers same = numbers_of(R"(
    c.position = mean(x in <0,1>(a) / <1,2> : x.position) + mean(y in <0,1>(a@0) / <1,2> : y.position);
  )");
  REQUIRE(same.folds.size() == 1);
  CHECK(same.folds.begin()->second == 2);
  const Numbers others = numbers_of(R"(
    c.position = mean(x in <0,1>(a) / <1,2> : x.position) + mean(x in <0,1>(a) / <1> : x.position)
               + sum(x in <0,1>(a) / <1,2> : x.position) + mean(x in <0,1>(a) : x.position)
               + mean(x in <0,1>(a) / <1,2> : x@0.position) + mean(x in <0,1>(a) / <1,2> : 2 * x.position);
  )");
  CHECK(others.folds.empty());
}

TEST_CASE("a fold whose terms know more than the visited dart is none of the orbit") {
  const Numbers numbers = numbers_of(
      "a.weight = sum(x in <0,1>(a) / <1> : x.weight * norm(x.position - a.position));");
  CHECK(numbers.folds.empty());
}

TEST_CASE("what several places ask of one dart is kept, as a whole") {
  const Numbers numbers = numbers_of(R"(
    a.weight = 2 * share(a);
    a.other = 3 * share(a);
  )",
                                     R"(
    function share(d) = d.weight * sum(x in <0,1>(d) : x.weight * norm(x.position - d.position)) + 1;
  )");
  CHECK(numbers.folds.empty());
  REQUIRE(numbers.lets.size() == 1);
  CHECK(numbers.lets.begin()->second == 2);
}
