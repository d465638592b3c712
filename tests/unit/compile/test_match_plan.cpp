// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>

#include "compile/compile.h"
#include "support/engine_rules.h"
#include "support/scheme_text.h"

using namespace gmsim;
using namespace gmsim::tests;
using compile::LinkStep;
using compile::MatchPlan;
using compile::Predicate;

namespace {

MatchPlan plan_of(std::string_view scheme, int dimension) {
  const check::Rule rule = rule_from_text(scheme, dimension);
  return compile::compile_pattern(rule.left, rule.hooks);
}

std::vector<LinkStep::Kind> kinds(const MatchPlan& plan) {
  std::vector<LinkStep::Kind> result;
  for (const LinkStep& step : plan.links) result.push_back(step.kind);
  return result;
}

}  // namespace

TEST_CASE("links are followed from the hook and checked as soon as both ends are known") {
  using enum LinkStep::Kind;
  CHECK(kinds(plan_of("a*<> b<> c<> | a-0-b b-1-c c-0-c a-2-a", 2)) ==
        std::vector{RequireFree, Follow, Follow, RequireFree});
  CHECK(kinds(plan_of("a*<> b<> c<> | b-1-c c-0-a a-1-b", 2)) ==
        std::vector{Follow, Follow, RequireLink});
  const MatchPlan two_hooks = plan_of("a*<0> b*<0> | a-2-a b-2-b", 2);
  CHECK(kinds(two_hooks) == std::vector{RequireFree, RequireFree});
  CHECK(two_hooks.positions == 1);
}

TEST_CASE("paths are walked forwards or backwards, after the links") {
  check::Rule rule = rule_from_text("p<> a*<> b<> | a-2-b", 2);
  rule.left.paths.push_back({{0, 1}, 0, 1, {}});
  const MatchPlan plan = compile::compile_pattern(rule.left, rule.hooks);
  REQUIRE(plan.links.size() == 2);
  CHECK(plan.links[0].kind == LinkStep::Kind::Follow);
  CHECK(plan.links[1].kind == LinkStep::Kind::FollowPath);
  CHECK(plan.links[1].path == std::vector<std::int8_t>{1, 0});
  CHECK(plan.links[1].to == 0);
}

TEST_CASE("label entries that follow from commuting links are not checked") {
  CHECK(plan_of("a*<0> b<0> | a-2-b", 2).labels.empty());
  CHECK(plan_of("a*<0 1> b<0 1> | a-3-b", 3).labels.empty());
  const MatchPlan adjacent = plan_of("a*<0> b<0> | a-1-b", 2);
  REQUIRE(adjacent.labels.size() == 1);
  CHECK(adjacent.labels[0].column == 1);
  CHECK(plan_of("a*<0> b<2> | a-2-b", 2).labels.size() == 1);  // another entry does not follow
  CHECK(plan_of("a*<0 1> b<0 _> | a-2-b", 2).labels.empty());
  // c follows from b once b is checked.
  CHECK(plan_of("a*<0> b<0> c<0> | a-1-b b-2-c", 2).labels.size() == 1);
}

TEST_CASE("conditions are judged as soon as their darts are known, unless they could fail") {
  const RuleBook rules(R"(
embedding position : vec3 on vertex merge mean;
embedding note : real on face optional;
rule chain(a) {
  left { a -0- b -1- c -0- d; }
  let x = c.position.x;
  where b.position.x > 0;
  where x > 1;
  where a.position.x > 2;
  where d.note > 0;
  where free(a, 2);
}
)",
                       2);
  const auto& predicates = rules.rule("chain").match.predicates;
  std::vector<std::uint32_t> after;
  for (const Predicate& predicate : predicates) after.push_back(predicate.after);
  // `a` at once, `b` after one link, the let and its reader after two; the last two wait.
  CHECK(after == std::vector<std::uint32_t>{0, 1, 2, 2, Predicate::kWholeMatch,
                                            Predicate::kWholeMatch});
  CHECK(predicates[2].kind == Predicate::Kind::Let);
}

TEST_CASE("a rule's table has room for what the rule adds") {
  const check::Rule rule = rule_from_text("a*<0 1> => a<0 _> b<_ 2> c<1 2> | a-1-b b-0-c", 2);
  const compile::Rule compiled = compile::compile_rule(rule, {});
  CHECK(compiled.match.nodes.size() == 1);
  CHECK(compiled.match.width == 3);
  CHECK(compiled.match.hook_orbit() == types::OrbitType{0, 1});
}
