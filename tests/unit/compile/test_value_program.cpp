// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>

#include "compile/compile_values.h"
#include "support/engine_rules.h"

using namespace gmsim;
using namespace gmsim::tests;
using compile::ValueOp;

namespace {

const char* const kData = R"(
embedding position : vec3 on vertex merge mean = (0, 0, 0);
embedding weight : real on <1> extensive = 0;
embedding label : real on <0,1> optional;
)";

/// The program of a cone over a face with these assignments; all embeddings are stored but one.
compile::ValueProgram program_of(const std::string& assignments, const std::string& unused = {}) {
  const RuleBook rules(kData + (R"(
rule cone(a) {
  left  { a<0,1>; }
  right { a<0,_> -1- b<_,2> -0- c<1,2>; }
)" + assignments) + "\n}\n",
                       2);
  std::vector<bool> in_use(rules.program().schema.size(), true);
  if (!unused.empty()) in_use[types::index(rules.embedding(unused))] = false;
  return compile::compile_values(rules.rule("cone"), rules.program().schema, in_use);
}

int count(const compile::ValueProgram& program, ValueOp op) {
  return static_cast<int>(std::count_if(program.code.begin(), program.code.end(),
                                        [&](const auto& by) { return by.op == op; }));
}

}  // namespace

TEST_CASE("a fold over an orbit is one, whichever of its darts is named") {
  const auto program = program_of(R"(
    c.position = mean(x in face(a) / vertex : x.position)
                 + mean(y in face(a@0@1) / vertex : y.position);
  )");
  CHECK(count(program, ValueOp::Mean) == 1);
  CHECK(count(program, ValueOp::Members) == 1);
}

TEST_CASE("a fold over another orbit, of another kind or with another term is another fold") {
  const auto program = program_of(R"(
    c.position = mean(x in face(a) / vertex : x.position)
                 + mean(x in face(a) / vertex : 2 * x.position)
                 + sum(x in face(a) / vertex : x.position);
  )");
  CHECK(count(program, ValueOp::Mean) == 2);
  CHECK(count(program, ValueOp::Sum) == 1);
  CHECK(count(program, ValueOp::Quotient) == 1);
}

TEST_CASE("what all rows share is computed in one lane") {
  const auto program = program_of(R"(
    c.position = (0, 0, 0);
    a.weight = sum(x in face(a) / <1> : x.weight / count(y in face(x) / <1>));
    c.weight = 0;
  )");
  REQUIRE(count(program, ValueOp::Sum) == 1);
  for (const compile::ValueInstruction& by : program.code) {
    if (by.op != ValueOp::Sum && by.op != ValueOp::Count) continue;
    CHECK(program.domains[by.domain].above == compile::LaneDomain::kNone);
    CHECK(program.domains[by.domain].joined == 3);
  }
}

TEST_CASE(
    "a value that is not stored makes no instruction where it is asked for, and no program else") {
  const std::string guarded = "c.weight = if has(a.label) then a.label else 0.5;";
  CHECK(count(program_of(guarded), ValueOp::Choose) == 1);
  const auto without = program_of(guarded, "label");
  CHECK(without.complete);
  CHECK(count(without, ValueOp::Choose) == 0);
  CHECK_FALSE(program_of("c.weight = a.label;", "label").complete);
}

TEST_CASE("an embedding that is not stored is not computed") {
  const auto program = program_of("c.position = (0, 0, 0); c.weight = 1;", "weight");
  REQUIRE(program.outputs.size() == 1);
  CHECK(program.outputs.front().assignment == 0);
}
