// SPDX-License-Identifier: MIT
// Gradients and directional derivatives of random graphs against differences in long double.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "engine/ir_evaluate.h"
#include "random_graph.h"

using namespace gmsim;
using tests::RandomGraph;
namespace ir = compile::ir;

namespace {

using Real = long double;
using Evaluator = engine::IrEvaluator<Real>;
using Point = std::vector<std::array<Real, 3>>;  // by input

Point random_point(std::uint32_t seed, std::size_t inputs) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  Point point(inputs);
  for (auto& entries : point)
    for (Real& x : entries) x = uniform(random);
  return point;
}

/// The values of a graph at a point.
class At {
 public:
  At(const ir::Graph& graph, const Point& point) : evaluator_(graph) {
    for (std::uint32_t k = 0; k < graph.inputs().size(); ++k) evaluator_.set_input(k, point[k]);
    evaluator_.run();
  }
  Real operator()(ir::NodeId id, int entry = 0) const { return evaluator_[id][entry]; }

 private:
  Evaluator evaluator_;
};

/// Fourth-order central difference along entry `entry` of input `input`.
Real difference(const ir::Graph& graph, ir::NodeId y, const Point& point, std::size_t input,
                int entry, Real h) {
  const auto value = [&](Real shift) {
    Point moved = point;
    moved[input][entry] += shift;
    return At(graph, moved)(y);
  };
  return (8 * (value(h) - value(-h)) - (value(2 * h) - value(-2 * h))) / (12 * h);
}

bool close(Real a, Real b, Real tolerance) {
  return std::abs(a - b) <= tolerance * std::max({Real(1), std::abs(a), std::abs(b)});
}

std::uint32_t number_of(const ir::Graph& graph, ir::NodeId input) { return graph[input].aux; }

int entries_of(const ir::Graph& graph, ir::NodeId input) {
  return graph[input].type == ir::ValueKind::Vec3 ? 3 : 1;
}

}  // namespace

TEST_CASE("gradients agree with central differences") {
  std::size_t compared = 0, kinks = 0;
  std::set<ir::Op> met;
  for (std::uint32_t seed = 0; seed < 250; ++seed) {
    CAPTURE(seed);
    RandomGraph twins(seed, false);
    twins.grow(25);
    const ir::NodeId y = twins.summary().simple;
    ir::Graph& graph = twins.simple;
    const std::vector<bool> used = ir::reachable(graph, std::array{y});
    const std::vector<ir::NodeId> gradient = ir::gradient(graph, y, twins.inputs());
    const Point point = random_point(seed, graph.inputs().size());
    const At here(graph, point);
    if (!std::isfinite(here(y)) || std::abs(here(y)) > 1e6L) continue;
    for (std::uint32_t i = 0; i < used.size(); ++i)
      if (used[i]) met.insert(graph[ir::NodeId{i}].op);
    for (std::size_t k = 0; k < twins.inputs().size(); ++k) {
      const ir::NodeId input = twins.inputs()[k];
      for (int entry = 0; entry < entries_of(graph, input); ++entry) {
        const std::uint32_t number = number_of(graph, input);
        const Real coarse = difference(graph, y, point, number, entry, 1e-3L);
        const Real fine = difference(graph, y, point, number, entry, 2.5e-4L);
        if (!close(coarse, fine, 1e-7L)) {  // abs, min, if … nearby
          ++kinks;
          continue;
        }
        CAPTURE(k);
        CAPTURE(entry);
        CHECK_MESSAGE(close(here(gradient[k], entry), fine, 1e-6L),
                      static_cast<double>(here(gradient[k], entry)), " against ",
                      static_cast<double>(fine), "\n", ir::to_string(graph, std::array{y}));
        ++compared;
      }
    }
  }
  CHECK(compared > 2'000);
  CHECK(kinks < compared / 5);
  CHECK(met.contains(ir::Op::Polar));
  CHECK(met.contains(ir::Op::Inverse));
  CHECK(met.contains(ir::Op::MaxEigenvalue));
  CHECK(met.contains(ir::Op::Atan2));
}

TEST_CASE("a directional derivative is the gradient in that direction") {
  std::size_t compared = 0;
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    CAPTURE(seed);
    RandomGraph twins(seed, true);
    twins.grow(30);
    const ir::NodeId y = twins.summary().simple;
    ir::Graph& graph = twins.simple;
    const std::vector<ir::NodeId> gradient = ir::gradient(graph, y, twins.inputs());
    std::vector<ir::NodeId> seeds;
    for (std::uint32_t k = 0; k < twins.inputs().size(); ++k)
      seeds.push_back(graph.input({.role = 100 + k}, graph[twins.inputs()[k]].type));
    const ir::NodeId slope = ir::directional(graph, y, twins.inputs(), seeds);
    const At here(graph, random_point(seed, graph.inputs().size()));
    Real expected = 0, scale = 1;
    for (std::size_t k = 0; k < seeds.size(); ++k) {
      for (int entry = 0; entry < entries_of(graph, seeds[k]); ++entry) {
        const Real part = here(gradient[k], entry) * here(seeds[k], entry);
        expected += part;
        scale = std::max(scale, std::abs(part));
      }
    }
    if (!std::isfinite(expected) || scale > 1e9L) continue;
    CHECK(std::abs(here(slope) - expected) <= 1e-12L * scale);
    ++compared;
  }
  CHECK(compared > 200);
}

TEST_CASE("second derivatives are symmetric") {
  std::size_t compared = 0;
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    RandomGraph twins(seed, false);
    twins.grow(20);
    const ir::NodeId y = twins.summary().simple;
    ir::Graph& graph = twins.simple;
    const std::vector<ir::NodeId> gradient = ir::gradient(graph, y, twins.inputs());
    // Rows of the Hessian: derivatives of the whole gradient along one axis of one input.
    struct Axis {
      std::size_t input;
      int entry;
    };
    std::vector<Axis> axes;
    std::vector<std::vector<ir::NodeId>> rows;
    for (std::size_t k = 0; k < twins.inputs().size(); ++k) {
      const ir::NodeId input = twins.inputs()[k];
      for (int entry = 0; entry < entries_of(graph, input); ++entry) {
        axes.push_back({k, entry});
        ir::NodeId seed_node = graph.constant(1);
        if (entries_of(graph, input) == 3)
          seed_node = graph.make(ir::Op::Vector, graph.constant(entry == 0),
                                 graph.constant(entry == 1), graph.constant(entry == 2));
        std::vector<ir::NodeId> row;
        for (const ir::NodeId g : gradient)
          row.push_back(ir::directional(graph, g, std::array{input}, std::array{seed_node}));
        rows.push_back(std::move(row));
      }
    }
    const At here(graph, random_point(seed, graph.inputs().size()));
    for (std::size_t i = 0; i < axes.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Real ij = here(rows[i][axes[j].input], axes[j].entry);
        const Real ji = here(rows[j][axes[i].input], axes[i].entry);
        if (!std::isfinite(ij) || std::abs(ij) > 1e6L) continue;
        CHECK(close(ij, ji, 1e-9L));
        ++compared;
      }
    }
  }
  CHECK(compared > 2'000);
}

TEST_CASE("frozen values are constant for derivatives") {
  ir::Graph graph;
  const auto x = graph.input({.role = 0}, ir::ValueKind::Real);
  const auto y = graph.make(ir::Op::Mul, x, graph.make(ir::Op::Frozen, graph.make(ir::Op::Mul, x, x)));
  const auto slope = ir::gradient(graph, y, std::array{x});
  const At here(graph, {{Real(3), 0, 0}});
  CHECK(here(y) == 27);
  CHECK(here(slope[0]) == 9);
  CHECK(here(ir::directional(graph, y, std::array{x}, std::array{graph.constant(1)})) == 9);
}

TEST_CASE("lengths and directions at zero have the derivative zero") {
  ir::Graph graph;
  const auto v = graph.input({.role = 0}, ir::ValueKind::Vec3);
  const auto w = graph.input({.role = 1}, ir::ValueKind::Vec3);
  const auto length = graph.make(ir::Op::Norm, v);
  const auto along = graph.make(ir::Op::Dot, graph.make(ir::Op::Normalize, v), w);
  const auto g1 = ir::gradient(graph, length, std::array{v});
  const auto g2 = ir::gradient(graph, along, std::array{v});
  const At here(graph, {{0, 0, 0}, {1, 2, 3}});
  for (int i = 0; i < 3; ++i) {
    CHECK(here(g1[0], i) == 0);
    CHECK(here(g2[0], i) == 0);
  }
}
