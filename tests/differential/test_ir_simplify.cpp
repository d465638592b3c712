// SPDX-License-Identifier: MIT
// Simplification changes no bit of what is finite, and every operation is met on the way.
#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <set>

#include "compile/ir_simplify.h"
#include "engine/ir_evaluate.h"
#include "random_graph.h"

using namespace gmsim;
using tests::RandomGraph;
using tests::TwinNode;
namespace ir = compile::ir;

namespace {

using Evaluator = engine::IrEvaluator<double>;

void set_inputs(const ir::Graph& graph, std::uint32_t seed, Evaluator& evaluator) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  for (std::uint32_t role = 0; role < 2 * RandomGraph::kInputs; ++role) {
    const double entries[3] = {uniform(random), uniform(random), uniform(random)};
    for (std::uint32_t k = 0; k < graph.inputs().size(); ++k)
      if (graph.inputs()[k].role == role) evaluator.set_input(k, entries);
  }
}

std::uint32_t entry_count(ir::ValueKind kind) {
  return kind == ir::ValueKind::Bool ? 1 : types::component_count({kind});
}

bool finite(const Evaluator::Entries& entries, std::uint32_t count) {
  for (std::uint32_t i = 0; i < count; ++i)
    if (!std::isfinite(entries[i])) return false;
  return true;
}

}  // namespace

TEST_CASE("a simplified graph computes the same bits as a plain one") {
  std::set<ir::Op> met;
  std::size_t compared = 0, smaller = 0;
  for (std::uint32_t seed = 0; seed < 1500; ++seed) {
    CAPTURE(seed);
    RandomGraph twins(seed, true);
    twins.grow(60);
    Evaluator plain(twins.plain), simple(twins.simple);
    set_inputs(twins.plain, seed + 1, plain);
    set_inputs(twins.simple, seed + 1, simple);
    plain.run();
    simple.run();
    // Something infinite may have become 0 on the way (ir_simplify.h): leave such graphs out.
    bool ordinary = true;
    for (std::uint32_t i = 0; i < twins.plain.size(); ++i) {
      const ir::Node& node = twins.plain[ir::NodeId{i}];
      ordinary = ordinary && finite(plain[ir::NodeId{i}], entry_count(node.type));
      // The angle of (-x, 0) is the one place where the sign of zero is seen.
      const bool half_turn = node.op == ir::Op::Atan2 && plain.number(node.operands[0]) == 0 &&
                             plain.number(node.operands[1]) <= 0;
      ordinary = ordinary && !half_turn;
    }
    if (!ordinary) continue;
    smaller += twins.simple.size() < twins.plain.size();
    for (const auto& [kind, pool] : twins.pools()) {
      for (const TwinNode& twin : pool) {
        met.insert(twins.plain[twin.plain].op);
        REQUIRE(twins.simple[twin.simple].type == kind);
        for (std::uint32_t i = 0; i < entry_count(kind); ++i) {
          CAPTURE(ir::name_of(twins.plain[twin.plain].op));
          REQUIRE(plain[twin.plain][i] == simple[twin.simple][i]);  // 0 and -0 agree
        }
        ++compared;
      }
    }
  }
  CHECK(compared > 50'000);
  CHECK(smaller > 500);
  constexpr int kOps = 0
#define IR_OP(id, name, operands, meaning) +1
#include "compile/ir_ops.def"
#undef IR_OP
      ;
  CHECK(met.size() == kOps);
}

TEST_CASE("operands stand before their users, and equal nodes are one") {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    RandomGraph twins(seed, true);
    twins.grow(80);
    std::set<std::string> seen;
    for (std::uint32_t i = 0; i < twins.simple.size(); ++i) {
      const ir::Node& node = twins.simple[ir::NodeId{i}];
      std::string text = std::to_string(static_cast<int>(node.op)) + "/" +
                         std::to_string(static_cast<int>(node.type)) + "/" +
                         std::to_string(node.aux) + "/" + std::to_string(node.constant);
      if (node.op == ir::Op::Constant) text += std::signbit(node.constant) ? "-" : "+";
      for (const ir::NodeId operand : node.operands) {
        if (operand == ir::kNone) continue;
        REQUIRE(ir::index(operand) < i);
        text += " " + std::to_string(ir::index(operand));
      }
      REQUIRE(seen.insert(text).second);
    }
  }
}

TEST_CASE("equal and opposite values share a node") {
  ir::Graph graph;
  const auto vector = [&](std::uint32_t role) {
    return graph.input({.role = role}, ir::ValueKind::Vec3);
  };
  const auto a = vector(0), b = vector(1);
  const auto k = graph.input({.role = 2}, ir::ValueKind::Real);
  const auto ab = graph.make(ir::Op::Sub, b, a), ba = graph.make(ir::Op::Sub, a, b);
  const auto force = [&](ir::NodeId d, double sign) {
    const auto factor = graph.make(ir::Op::Mul, graph.constant(sign * 0.3), k);
    return graph.make(ir::Op::Scale, factor, graph.make(ir::Op::Normalize, d));
  };
  CHECK(force(ab, 1) == force(ba, -1));
  CHECK(graph.make(ir::Op::Neg, force(ab, 1)) == force(ba, 1));
  CHECK(graph.make(ir::Op::Norm, ab) == graph.make(ir::Op::Norm, ba));
  CHECK(graph.make(ir::Op::Cross, a, b) ==
        graph.make(ir::Op::Neg, graph.make(ir::Op::Cross, b, a)));
  const auto twice = graph.make(ir::Op::Add, k, k);
  CHECK(graph.make(ir::Op::Mul, graph.constant(0.5), twice) == k);
}

TEST_CASE("what a branch excludes does not come back as 0 times infinity") {
  ir::Graph graph;
  const auto x = graph.input({.role = 0}, ir::ValueKind::Real);
  const auto positive = graph.make(ir::Op::Less, graph.constant(0), x);
  const auto root = graph.make(ir::Op::Sqrt, x);
  const auto energy = graph.make(ir::Op::Select, positive, root, graph.constant(0));
  const auto slope = ir::gradient(graph, graph.make(ir::Op::Mul, energy, graph.constant(3)),
                                  std::array{x});
  Evaluator evaluator(graph);
  for (const double at : {0.0, 0.25}) {
    evaluator.set_input(0, std::array{at});
    evaluator.run();
    CHECK(evaluator.number(slope[0]) == (at == 0.0 ? 0.0 : 3.0));
  }
}
