// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <sstream>

#include "compile/compile.h"
#include "support/engine_rules.h"

using namespace gmsim;
using namespace gmsim::tests;

namespace {

std::string printed(const RuleBook& rules, std::string_view only) {
  std::ostringstream out;
  compile::print_program(rules.program(), out, only);
  return out.str();
}

}  // namespace

TEST_CASE("the plan of a rule reads as what is done") {
  const RuleBook rules(R"(
embedding x : real on vertex merge mean;
rule sever(a) {
  left { a<0> -2- b<0>; } right { a -2- a; b -2- b; }
  param limit : real = 3;
  where a.x > limit;
  a.x = a.x;
}
operation all_around on vertex(a) {
  for d in vertex(a) where not free(d, 2) { apply sever(d; limit = 2.0); }
}
)",
                       2);
  CHECK(printed(rules, "sever") ==
        "rule sever  dimension 2, 3 slots\n"
        "  param limit : real = 3\n"
        "  match a<0> b<0>\n"
        "    start a\n"
        "    default limit := 3\n"
        "    where a.x > limit\n"
        "    follow b := a@2\n"
        "    rows along 1 positions\n"
        "    all darts distinct\n"
        "  rewrite\n"
        "    touch a in <2>\n"
        "    touch b in <2>\n"
        "    link a -2- a\n"
        "    link b -2- b\n"
        "    value a.x := a.x\n"
        "    spread x\n");
  const std::string operation = printed(rules, "all_around");
  CHECK(operation.find("on <1,2>(a)") != std::string::npos);
  CHECK(operation.find("for d in ") != std::string::npos);
  CHECK(operation.find("apply sever(d; limit = 2") != std::string::npos);
}

TEST_CASE("every item of the library prints, in every dimension") {
  for (int dimension = 1; dimension <= 3; ++dimension) {
    const RuleBook rules("", dimension, true);
    const std::string text = printed(rules, "");
    for (const compile::Rule& rule : rules.program().rules) {
      CHECK(text.find("rule " + rule.name + "  dimension") != std::string::npos);
    }
  }
}
