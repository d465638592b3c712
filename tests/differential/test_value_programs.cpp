// SPDX-License-Identifier: MIT
// Value programs against the tree evaluator: the same bits, for the values of the library's rules
// and for random expressions; where a program gives up, the trees decide, so it must not do so
// often.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <bit>
#include <random>

#include "compile/compile_values.h"
#include "engine/value_machine.h"
#include "gmap/mesh_builders.h"
#include "random_world.h"
#include "support/engine_rules.h"
#include "support/mesh_groups.h"

using namespace gmsim;
using namespace gmsim::tests;

namespace {

struct Tally {
  int same = 0;        // values that both give
  int incomplete = 0;  // rules that lanes cannot express
  int given_up = 0;    // runs that gave up though the trees have all values
};

/// The bits of numbers.
std::string bits(std::span<const double> numbers) {
  std::string text;
  for (const double x : numbers) text += fmt::format("{:016x} ", std::bit_cast<std::uint64_t>(x));
  return text;
}

/// The bits of the tree's value; empty after a failure.
std::string tree_value(engine::TreeEvaluator& tree, const types::Expr& expr, engine::Frame& frame) {
  std::vector<double> value(types::component_count(expr.type));
  if (tree.evaluate(expr, frame, value)) return bits(value);
  static_cast<void>(tree.take_failure());
  return {};
}

void compare_match(const engine::State& state, const compile::Rule& rule,
                   const compile::ValueProgram& program, const engine::Match& match,
                   engine::Frame& frame, Tally& tally) {
  if (rule.rewrite.assignments.empty()) return;
  if (!program.complete) return void(++tally.incomplete);
  engine::ValueMachine machine(state);
  engine::RowPlan rows(rule, match);
  engine::TreeEvaluator tree(state);
  const bool ran = machine.run(program, match, rows, frame);
  bool all = true;
  for (const compile::ValueProgram::Output& output : program.outputs) {
    const compile::Assignment& assignment = rule.rewrite.assignments[output.assignment];
    std::size_t lane = 0;
    for (const std::uint32_t row : rows.groups(0, assignment.joined_rows()).first) {
      CAPTURE(row);
      for (compile::Column column = 0; column < rule.match.nodes.size(); ++column) {
        frame.set(rule.match.nodes[column].slot, match.dart(row, column));
      }
      for (const compile::Predicate& predicate : rule.match.predicates) {
        if (predicate.kind != compile::Predicate::Kind::Let) continue;
        CHECK(tree.assign(*predicate.value, predicate.slot, frame));
      }
      const std::string expected = tree_value(tree, *assignment.value, frame);
      all = all && !expected.empty();
      if (!ran) continue;
      const std::span<const double> values = machine.value(output.value);
      const std::size_t size = types::component_count(assignment.value->type);
      REQUIRE(bits(values.subspan(lane++ * size, size)) == expected);
      ++tally.same;
    }
  }
  tally.given_up += !ran && all;
}

std::vector<bool> columns_in_use(const engine::State& state) {
  std::vector<bool> in_use(state.program.schema.size());
  for (const types::EmbeddingId id : state.store.embeddings()) in_use[types::index(id)] = true;
  return in_use;
}

void compare_library(const gmap::Mesh& mesh, std::uint64_t seed, Tally& tally) {
  const RuleBook rules("", mesh.dimension, true);
  const auto state = make_state(rules.program(), mesh, seed);
  std::mt19937_64 random(seed);
  for (double& x : state->store.column(rules.embedding("position")).data()) {
    x += 1e-3 * static_cast<double>(random() >> 11) * 0x1p-53;
  }
  engine::Matcher matcher(*state);
  for (const compile::Rule& rule : rules.program().rules) {
    CAPTURE(rule.name);
    const compile::ValueProgram program =
        compile::compile_values(rule, rules.program().schema, columns_in_use(*state));
    for (int k = 0; k < 6; ++k) {
      std::vector<DartId> hooks(rule.match.hooks.size());
      for (DartId& hook : hooks) {
        hook = DartId{static_cast<std::uint32_t>(random() % state->map.dart_end())};
      }
      engine::Frame frame(rule.frame_size);
      for (const compile::Parameter& parameter : rule.parameters) {
        if (parameter.default_value) continue;
        frame.set(parameter.slot,
                  std::vector<double>(types::component_count(parameter.type), 0.25));
      }
      engine::Match match;
      if (!matcher.match(rule.match, hooks, frame, match)) continue;
      compare_match(*state, rule, program, match, frame, tally);
    }
  }
}

/// A rule without a right side that gives a value to a node of such a label.
compile::Rule value_rule(const check::CheckedExpression& expression,
                         const std::vector<std::int8_t>& label, types::EmbeddingId embedding) {
  compile::Rule rule;
  rule.frame_size = expression.frame_size;
  rule.match.nodes.push_back({"a", label, expression.dart, {}});
  rule.match.hooks = {0};
  rule.match.positions = static_cast<std::uint32_t>(label.size());
  rule.match.width = 1;
  rule.rewrite.kept_columns = 1;
  rule.rewrite.assignments.push_back({0, embedding, expression.value, {}, {}, {}});
  return rule;
}

void compare_expression(RandomWorld& world, const std::string& text, const char* embedding,
                        const std::vector<std::int8_t>& label, Tally& tally) {
  CAPTURE(text);
  const auto id = world.state().program.schema.find(embedding);
  const compile::Rule rule = value_rule(world.checked(text), label, *id);
  const compile::ValueProgram program =
      compile::compile_values(rule, world.state().program.schema, columns_in_use(world.state()));
  engine::Matcher matcher(world.state());
  for (int k = 0; k < 4; ++k) {
    const DartId hook = world.random_dart();
    CAPTURE(types::index(hook));
    engine::Frame frame(rule.frame_size);
    engine::Match match;
    REQUIRE(matcher.match(rule.match, {&hook, 1}, frame, match));
    compare_match(world.state(), rule, program, match, frame, tally);
  }
}

void compare_world(const gmap::Mesh& mesh, std::uint32_t seed, int expressions, Tally& tally) {
  CAPTURE(seed);
  RandomWorld world(mesh, seed);
  RandomExpression random(seed, mesh.dimension);
  const std::vector<std::vector<std::int8_t>> labels = {{}, {0}, {0, 1}, {1, 2}, {2, 0}, {1, 0, 2}};
  for (int i = 0; i < expressions; ++i) {
    const int depth = 1 + i % 4;
    const auto& label = labels[static_cast<std::size_t>(i / 8) % labels.size()];
    const auto compare = [&](const std::string& text, const char* embedding) {
      compare_expression(world, text, embedding, label, tally);
    };
    switch (i % 8) {
      case 0:
        compare(random.vec(depth), "velocity");
        break;
      case 1:
        compare(random.mat(depth), "m");
        break;
      case 2:
        compare(random.sym(depth), "s");
        break;
      case 3:
        compare(random.vec2(depth), "p2");
        break;
      case 4:
        compare(random.mat2(depth), "m2");
        break;
      case 5:
        compare(random.truth(depth), "flag");
        break;
      case 6:
        compare(random.whole(depth), "k");
        break;
      default:
        compare(random.real(depth), "r");
        break;
    }
  }
}

}  // namespace

TEST_CASE("values of the library's rules are those of the trees, bit by bit") {
  constexpr std::uint64_t kSeed = 20260301;
  CAPTURE(kSeed);
  Tally tally;
  compare_library(gmap::grid(3, 2, 1.0, 2.0, gmap::GridCells::Quads), kSeed, tally);
  compare_library(gmap::grid(3, 3, 1.0, 1.0, gmap::GridCells::Mix2), kSeed + 1, tally);
  compare_library(gmap::box({2, 1, 2}, {1.0, 2.0, 3.0}, gmap::BoxElements::Hexes), kSeed + 2,
                  tally);
  compare_library(gmap::box({1, 2, 1}, {1.0, 2.0, 1.0}, gmap::BoxElements::Tets5), kSeed + 3,
                  tally);
  CHECK(tally.same > 2'000);
  CHECK(tally.incomplete == 0);
  CHECK(tally.given_up == 0);
}

TEST_CASE("values of random expressions are those of the trees, bit by bit") {
  Tally tally;
  compare_world(gmap::grid(3, 2, 1, 1, gmap::GridCells::Mix2), 1, 200, tally);
  compare_world(gmap::grid(2, 2, 1, 1, gmap::GridCells::Tri4), 2, 200, tally);
  compare_world(tests::torus(3, 3), 3, 100, tally);
  compare_world(gmap::box({2, 1, 1}, {1, 1, 1}, gmap::BoxElements::Hexes), 4, 60, tally);
  CAPTURE(tally.incomplete);
  CAPTURE(tally.given_up);
  CHECK(tally.same > 5'000);
  CHECK(10 * (tally.incomplete + tally.given_up) < tally.same);
}
