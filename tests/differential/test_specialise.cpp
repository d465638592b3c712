// SPDX-License-Identifier: MIT
// A specialised expression computes the same bits as the tree evaluator, at every match of its
// shape, and the ways to a match's shape (with a graph, without, by walks alone) agree.
#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "compile/specialise.h"
#include "engine/ir_evaluate.h"
#include "engine/tree_eval.h"
#include "random_world.h"
#include "support/mesh_groups.h"

using namespace gmsim;
using compile::MatchRoles;
using tests::RandomWorld;
using support::DiagnosticKind;
using types::DartId;
using types::ValueKind;

namespace {

struct Tally {
  std::size_t compared = 0;
  std::size_t not_static = 0;
  std::size_t fast = 0;
  std::set<types::ExprKind> kinds;
};

void note_kinds(const types::Expr& expr, std::set<types::ExprKind>& kinds) {
  kinds.insert(expr.kind);
  for (const auto& argument : expr.args)
    if (argument) note_kinds(*argument, kinds);
}

bool same_roles(const std::vector<compile::Role>& a, const std::vector<compile::Role>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.type == y.type && x.row == y.row && x.dart == y.dart;
  });
}

/// The literal bits, except that 0 and -0 are the same and polar rotations of 2x2 matrices take
/// their length in another way.
void compare(const std::vector<double>& tree, const std::vector<double>& graph) {
  REQUIRE(tree.size() == graph.size());
  for (std::size_t i = 0; i < tree.size(); ++i) REQUIRE(tree[i] == graph[i]);
}

std::vector<double> graph_value(const compile::Shape& shape, const MatchRoles& roles,
                                const engine::State& state) {
  engine::IrEvaluator<double> evaluator(shape.graph);
  engine::gather_inputs(shape, roles.roles, state, evaluator);
  evaluator.run();
  std::vector<double> value;
  for (const auto id : shape.values.at(0)) {
    const std::uint32_t count = types::component_count({shape.graph[id].type});
    value.insert(value.end(), evaluator[id].begin(), evaluator[id].begin() + count);
  }
  return value;
}

void check_expression(RandomWorld& world, const std::string& text, Tally& tally) {
  CAPTURE(text);
  const check::CheckedExpression expression = world.checked(text);
  const compile::ItemBody body = compile::expression_body(
      "expression", types::OrbitType{}, expression.dart, expression.frame_size);
  const compile::Wanted wanted{.values = {expression.value}};
  compile::ShapeSet shapes(world.world(), body, wanted, world.value_sources());
  compile::Specialiser specialiser(world.world(), body, wanted, world.value_sources());
  engine::TreeEvaluator tree(world.state());
  engine::Frame frame;
  for (int i = 0; i < 12; ++i) {
    const DartId dart = world.random_dart();
    CAPTURE(types::index(dart));
    frame.reset(expression.frame_size);
    frame.set(expression.dart, dart);
    const auto expected = tree.evaluate(*expression.value, frame);
    std::optional<engine::EvalFailure> failure;
    if (!expected) failure = tree.take_failure();
    MatchRoles roles;
    const auto shape = shapes.classify(std::array{dart}, roles);
    if (!shape) {
      const DiagnosticKind kind = shapes.failure().diagnostic.kind;
      CAPTURE(shapes.failure().diagnostic.message);
      if (failure && failure->diagnostic.kind == kind) {
        CHECK(failure->missing_optional == shapes.failure().not_here);
      } else {  // both branches of a choice between values are computed
        REQUIRE((kind == DiagnosticKind::NotConstant || kind == DiagnosticKind::OpenFace ||
                 kind == DiagnosticKind::MissingEmbeddingValue ||
                 kind == DiagnosticKind::EmptyFold));
        ++tally.not_static;
      }
      continue;
    }
    REQUIRE_MESSAGE(expected.has_value(), failure->diagnostic.message);
    MatchRoles traced, built;
    compile::Shape again;
    REQUIRE(specialiser.trace(std::array{dart}, traced));
    REQUIRE(specialiser.build(std::array{dart}, built, again));
    REQUIRE(traced.key == built.key);
    REQUIRE(traced.key == shapes[*shape].key);
    REQUIRE(same_roles(traced.roles, built.roles));
    REQUIRE(same_roles(traced.roles, roles.roles));
    REQUIRE(again.graph.size() == shapes[*shape].graph.size());
    tally.fast += roles.key.empty() && !traced.key.empty();
    const bool finite = expected->finite();
    if (!finite) continue;
    compare(expected->data, graph_value(shapes[*shape], roles, world.state()));
    ++tally.compared;
  }
  note_kinds(*expression.value, tally.kinds);
}

void check_world(const gmap::Mesh& mesh, std::uint32_t seed, int expressions, Tally& tally) {
  CAPTURE(seed);
  RandomWorld world(mesh, seed);
  tests::RandomExpression random(seed, mesh.dimension);
  for (int i = 0; i < expressions; ++i) {
    const int depth = 1 + i % 4;
    switch (i % 8) {
      case 0: check_expression(world, random.vec(depth), tally); break;
      case 1: check_expression(world, random.mat(depth), tally); break;
      case 2: check_expression(world, random.sym(depth), tally); break;
      case 3: check_expression(world, random.vec2(depth), tally); break;
      case 4: check_expression(world, random.mat2(depth), tally); break;
      case 5: check_expression(world, random.truth(depth), tally); break;
      case 6: check_expression(world, random.whole(depth), tally); break;
      default: check_expression(world, random.real(depth), tally); break;
    }
  }
}

}  // namespace

TEST_CASE("specialised expressions compute the bits of the tree evaluator") {
  Tally tally;
  check_world(gmap::grid(3, 2, 1, 1, gmap::GridCells::Mix2), 1, 250, tally);
  check_world(gmap::grid(2, 2, 1, 1, gmap::GridCells::Tri4), 2, 250, tally);
  check_world(tests::torus(3, 3), 3, 150, tally);
  check_world(gmap::box({2, 1, 1}, {1, 1, 1}, gmap::BoxElements::Hexes), 4, 100, tally);
  check_world(gmap::box({1, 1, 1}, {1, 1, 1}, gmap::BoxElements::Tets6), 5, 100, tally);
  CHECK(tally.compared > 6'000);
  CHECK(tally.not_static < tally.compared / 5);
  CHECK(tally.fast > 1'000);
  using types::ExprKind;
  for (auto kind = 0; kind <= static_cast<int>(ExprKind::Frozen); ++kind) {
    const auto expr_kind = static_cast<ExprKind>(kind);
    const bool elsewhere = expr_kind == ExprKind::Forces || expr_kind == ExprKind::ForceOn ||
                           expr_kind == ExprKind::Grad || expr_kind == ExprKind::AllOrbits;
    CAPTURE(kind);
    CHECK((elsewhere || tally.kinds.contains(expr_kind)));
  }
}
