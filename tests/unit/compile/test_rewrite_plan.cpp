// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "compile/compile.h"
#include "support/engine_rules.h"
#include "support/scheme_text.h"

using namespace gmsim;
using namespace gmsim::tests;
using compile::LinkWrite;
using compile::NodeFate;
using compile::RewritePlan;
using types::OrbitType;

namespace {

RewritePlan plan_of(std::string_view scheme, int dimension) {
  return compile::compile_rewrite(rule_from_text(scheme, dimension), {});
}

}  // namespace

TEST_CASE("only links that differ are written") {
  const RewritePlan cut = plan_of("a*<0> b<0> | a-2-b => a<0> b<0> | a-2-a b-2-b", 2);
  CHECK(cut.writes.size() == 2);
  REQUIRE(cut.changes.size() == 2);
  CHECK(cut.changes[0].links == OrbitType{2});
  CHECK(cut.changes[0].fate == NodeFate::Preserved);
  CHECK(cut.changed_links == OrbitType{2});
  CHECK(cut.affects({1, 2}));
  CHECK(!cut.affects({0, 1}));
  CHECK(!cut.affects({}));

  const RewritePlan dual = plan_of("a*<0 1 2> => a<2 1 0>", 2);
  REQUIRE(dual.writes.size() == 2);
  CHECK(dual.writes[0].position == 0);
  CHECK(dual.writes[0].dimension == 2);
  CHECK(dual.writes[1].position == 2);
  CHECK(dual.writes[1].dimension == 0);
}

TEST_CASE("created and removed darts change in every dimension") {
  const RewritePlan cone = plan_of("a*<0 1> => a<0 _> b<_ 2> c<1 2> | a-1-b b-0-c", 2);
  CHECK(cone.kept_columns == 1);
  CHECK(cone.created_columns == 2);
  CHECK(cone.created_names == std::vector<std::string>{"b", "c"});
  REQUIRE(cone.changes.size() == 3);
  CHECK(cone.changes[0].links == OrbitType{1});
  CHECK(cone.changes[1].links == OrbitType{0, 1, 2});
  CHECK(cone.changes[1].fate == NodeFate::Created);
  CHECK(cone.writes.size() == 5);
  CHECK(cone.creates());
  CHECK(!cone.removes());
  CHECK(cone.affects({}));

  const RewritePlan removal = plan_of("a*<0 1> b<0 _> | a-2-b => b<0 _> | b-2-b", 2);
  CHECK(removal.removes());
  REQUIRE(removal.changes.size() == 2);
  CHECK(removal.changes[0].fate == NodeFate::Removed);
  CHECK(removal.writes.size() == 1);
}

TEST_CASE("a rule without right side writes nothing") {
  const RewritePlan plan = plan_of("a*<0> b<0> | a-2-b", 2);
  CHECK(plan.writes.empty());
  CHECK(plan.changes.empty());
  CHECK(!plan.affects({0, 1, 2}));
}

TEST_CASE("an assignment is evaluated once for the rows that its orbit joins") {
  const RuleBook rules(R"(
embedding position : vec3 on vertex merge mean;
embedding mass : real on <1> extensive;
rule cut(a) {
  left { a<0,2>; } right { a<_,2> -0- m<1,2>; }
  m.position = 0.5 * (a.position + a@0.position);
  m.mass = 0.5 * (a.mass + a@0.mass);
  a.mass = 0.5 * a.mass;
}
)",
                       2);
  const auto& assignments = rules.rule("cut").rewrite.assignments;
  REQUIRE(assignments.size() == 3);
  CHECK(assignments[0].joined == std::vector<std::uint32_t>{0, 1});
  CHECK(assignments[1].joined == std::vector<std::uint32_t>{0});
  CHECK(assignments[2].joined.empty());
  CHECK(assignments[0].column == 1);
  CHECK(assignments[2].column == 0);
}
