// SPDX-License-Identifier: MIT
// The values of the library's rules, with what they share kept and with everything evaluated anew:
// the same bits.
#include <doctest/doctest.h>

#include <cstring>
#include <random>

#include "engine/matcher.h"
#include "gmap/mesh_builders.h"
#include "gmap/orbit_walk.h"
#include "support/engine_rules.h"

using namespace gmsim;
using namespace gmsim::tests;
using types::DartId;

namespace {

/// A value is known by its bits; a failure by its text.
std::string value_text(engine::TreeEvaluator& evaluator, const types::Expr& expr,
                       engine::Frame& frame) {
  std::vector<double> value(types::component_count(expr.type));
  if (!evaluator.evaluate(expr, frame, value)) return evaluator.take_failure().diagnostic.message;
  std::string bytes(value.size() * sizeof(double), '\0');
  std::memcpy(bytes.data(), value.data(), bytes.size());
  return bytes;
}

void bind(const compile::Rule& rule, const engine::Match& match, std::uint32_t row,
          engine::Frame& frame) {
  for (compile::Column column = 0; column < rule.match.nodes.size(); ++column) {
    frame.set(rule.match.nodes[column].slot, match.dart(row, column));
  }
}

/// Compares every value of a rule at every row of a match; returns how many there were.
int compare(engine::State& state, const compile::Rule& rule, std::vector<DartId> hooks) {
  engine::Matcher matcher(state);
  engine::Frame frame(rule.frame_size);
  for (const compile::Parameter& parameter : rule.parameters) {
    if (parameter.default_value) continue;
    frame.set(parameter.slot, std::vector<double>(types::component_count(parameter.type), 0.25));
  }
  engine::Match match;
  if (!matcher.match(rule.match, hooks, frame, match)) return 0;
  engine::TreeEvaluator plain(state), keeping(state);
  const engine::TreeEvaluator::Keeping kept(keeping);
  int values = 0;
  for (const compile::Assignment& assignment : rule.rewrite.assignments) {
    for (std::uint32_t row = 0; row < match.rows; ++row) {
      CAPTURE(row);
      bind(rule, match, row, frame);
      const std::string expected = value_text(plain, *assignment.value, frame);
      CHECK(value_text(keeping, *assignment.value, frame) == expected);
      ++values;
    }
  }
  return values;
}

int compare_library(const gmap::Mesh& mesh, std::uint64_t seed) {
  const RuleBook rules("", mesh.dimension, true);
  const auto state = make_state(rules.program(), mesh, seed);
  const types::EmbeddingId position = rules.embedding("position");
  std::mt19937_64 random(seed);
  for (double& x : state->store.column(position).data()) {
    x += 1e-3 * static_cast<double>(random() >> 11) * 0x1p-53;
  }
  int values = 0;
  for (const compile::Rule& rule : rules.program().rules) {
    if (rule.match.hooks.size() != 1) continue;
    CAPTURE(rule.name);
    for (int k = 0; k < 4; ++k) {
      values += compare(*state, rule, {DartId{static_cast<std::uint32_t>(
                                          random() % state->map.dart_end())}});
    }
  }
  return values;
}

}  // namespace

TEST_CASE("kept values are those that an evaluation from scratch gives") {
  constexpr std::uint64_t kSeed = 20260301;
  CAPTURE(kSeed);
  CHECK(compare_library(gmap::grid(3, 2, 1.0, 2.0, gmap::GridCells::Quads), kSeed) > 100);
  CHECK(compare_library(gmap::grid(3, 3, 1.0, 1.0, gmap::GridCells::Mix2), kSeed + 1) > 100);
  CHECK(compare_library(gmap::box({2, 1, 2}, {1.0, 2.0, 3.0}, gmap::BoxElements::Hexes), kSeed + 2) > 100);
  CHECK(compare_library(gmap::box({1, 2, 1}, {1.0, 2.0, 1.0}, gmap::BoxElements::Tets5), kSeed + 3) > 100);
}
