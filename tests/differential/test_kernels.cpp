// SPDX-License-Identifier: MIT
// Register programs against the evaluator that walks graphs: the same bits at every block size and
// on every instruction set.
#include <doctest/doctest.h>

#include <random>
#include <vector>

#include "gmap/mesh_builders.h"
#include "kernel_columns.h"
#include "library_world.h"
#include "random_graph.h"

using namespace gmsim;
using compile::KernelOp;
using compile::ir::Graph;
using compile::ir::NodeId;
using compile::ir::Op;
using compile::ir::ValueKind;

namespace {

void compare_graph(const Graph& graph, const std::vector<NodeId>& roots, std::uint32_t matches,
                   std::mt19937& random) {
  const compile::Kernel kernel = compile::compile_kernel(graph, roots);
  const auto columns = tests::random_columns(kernel.inputs, matches, random);
  tests::compare_everywhere(graph, roots, columns, matches);
}

std::size_t count(const compile::Kernel& kernel, KernelOp op) {
  std::size_t result = 0;
  for (const auto& instruction : kernel.code) result += instruction.op == op;
  return result;
}

NodeId position(Graph& graph, std::uint32_t role) {
  return graph.input({.role = role}, ValueKind::Vec3);
}
NodeId parameter(Graph& graph, std::uint32_t role) {
  return graph.input({.embedding = compile::EmbeddingId{1}, .role = role}, ValueKind::Real);
}

/// Gives each input the value that its function says, on one match.
struct OneMatch {
  std::vector<std::array<double, 4>> values;
  std::vector<engine::InputBinding> bindings(const compile::Kernel& kernel) {
    std::vector<engine::InputBinding> result;
    for (std::size_t k = 0; k < kernel.inputs.size(); ++k) result.push_back({values[k].data(), 0});
    return result;
  }
};

}  // namespace

TEST_CASE("random graphs give the bits of the tree evaluator") {
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    tests::RandomGraph graph(seed, true);
    std::mt19937 random(seed);
    graph.grow(10 + static_cast<int>(seed));
    const NodeId summary = graph.summary().plain;
    std::vector<NodeId> plain = {summary}, simple;
    for (const auto& [kind, pool] : graph.pools()) {
      plain.push_back(pool.back().plain);
      simple.push_back(pool.back().simple);
    }
    compare_graph(graph.plain, plain, 1 + seed * 7 % 150, random);
    compare_graph(graph.simple, simple, 70, random);
  }
}

TEST_CASE("every operation gives the bits of the tree evaluator") {
  // Each operation by itself, on columns with every layout.
  for (std::uint32_t seed = 1; seed <= 1000; ++seed) {
    CAPTURE(seed);
    tests::RandomGraph graph(seed, true);
    std::mt19937 random(seed);
    const NodeId root = graph.random_operation().plain;
    const compile::Kernel kernel = compile::compile_kernel(graph.plain, std::span(&root, 1));
    const auto columns = tests::random_columns(kernel.inputs, 19, random);
    const auto expected = tests::evaluate_each(graph.plain, {root}, kernel.inputs, columns, 19);
    for (const engine::Isa isa : engine::available_isas())
      tests::compare_kernel(graph.plain, {root}, 8, isa, columns, expected, 19);
  }
}

TEST_CASE("rotations and eigenvectors of any matrix give the bits of the tree evaluator") {
  Graph graph;
  const NodeId a = position(graph, 0), b = position(graph, 1), c = position(graph, 2);
  const NodeId m = graph.make(Op::Columns, a, b, c), s = graph.make(Op::Sym, m);
  const std::vector<NodeId> roots = {
      graph.make(Op::Polar, m), graph.make(Op::MaxEigenvalue, s), graph.make(Op::MaxEigenvector, s),
      graph.make(Op::MinEigenvalue, s), graph.make(Op::MinEigenvector, s)};
  std::mt19937 random(11);
  compare_graph(graph, roots, 300, random);
}

TEST_CASE("programs of the whole library give the bits of the tree evaluator") {
  std::size_t shapes_seen = 0;
  std::mt19937 random(5);
  const auto check_world = [&](const gmap::Mesh& mesh, std::uint32_t seed) {
    tests::LibraryWorld world(mesh, seed);
    for (std::uint32_t i = 0; i < world.program().interactions.size(); ++i) {
      const compile::InteractionBody& body = world.program().interaction_bodies[i];
      CAPTURE(body.name);
      compile::ShapeSet shapes(world.world(), body, compile::wanted_forces(body, true),
                               world.value_sources());
      world.each_match(i, [&](const std::vector<types::DartId>& nodes, engine::Frame&) {
        compile::MatchRoles roles;
        REQUIRE(shapes.classify(nodes, roles));
      });
      for (std::size_t s = 0; s < shapes.size() && s < 3; ++s) {
        compare_graph(shapes[s].graph, shapes[s].roots(), 67, random);
        ++shapes_seen;
      }
    }
  };
  check_world(gmap::grid(2, 2, 2, 2, gmap::GridCells::Mix2), 1);
  check_world(gmap::box({2, 1, 1}, {2, 1, 1}, gmap::BoxElements::Hexes), 3);
  check_world(gmap::box({1, 1, 1}, {1, 1, 1}, gmap::BoxElements::Tets5), 4);
  CHECK(shapes_seen > 20);
}

TEST_CASE("a spring becomes a short program") {
  Graph graph;
  const NodeId a = position(graph, 0), b = position(graph, 1);
  const NodeId d = graph.make(Op::Sub, a, b);
  const NodeId stretch = graph.make(Op::Sub, graph.make(Op::Norm, d), parameter(graph, 0));
  const NodeId pull = graph.make(Op::Mul, graph.constant(60), stretch);
  const NodeId force = graph.make(Op::Scale, pull, graph.make(Op::Normalize, d));
  const NodeId roots[] = {force};
  const compile::Kernel kernel = compile::compile_kernel(graph, roots);
  CHECK(to_string(kernel) ==
        "u0.1 = 60\n"
        "r0.3 = gatherdiff in0 in1\n"
        "r0.4 = unitnorm r0\n"
        "r4.1 = gather in2\n"
        "r4.1 = sub r3 r4\n"
        "r4.1 = mul u0 r4\n"
        "r0.3 = scale r4 r0\n"
        "out0 = store r0\n");
  CHECK(kernel.bytes() == 8 * (3 + 3 + 1 + 3));
  CHECK(kernel.operations() == 3 + 9 + 1 + 1 + 3);
  CHECK(kernel.doubles == 5 * 64 + 8);
}

TEST_CASE("what is the same for all matches is computed once") {
  Graph graph;
  const NodeId time = graph.input({.source = compile::ir::Input::Source::Time}, ValueKind::Real);
  const NodeId wave = graph.make(Op::Sin, graph.make(Op::Mul, graph.constant(3), time));
  const NodeId root = graph.make(Op::Scale, wave, position(graph, 0));
  const compile::Kernel kernel = compile::compile_kernel(graph, std::span(&root, 1));
  CHECK(kernel.once.size() == 3);
  CHECK(count(kernel, KernelOp::Sin) == 0);
  CHECK(kernel.code.size() == 3);
  std::mt19937 random(1);
  compare_graph(graph, {root}, 100, random);
}

TEST_CASE("both ends of a difference are gathered apart only where both are wanted") {
  Graph graph;
  const NodeId a = position(graph, 0), b = position(graph, 1), c = position(graph, 2);
  const NodeId roots[] = {graph.make(Op::Sub, b, a), graph.make(Op::Sub, c, a),
                          graph.make(Op::Cross, a, b)};
  const compile::Kernel kernel = compile::compile_kernel(graph, roots);
  CHECK(count(kernel, KernelOp::Sub) == 1);
  CHECK(count(kernel, KernelOp::GatherDifference) == 1);
  CHECK(count(kernel, KernelOp::Gather) == 2);
}

TEST_CASE("registers are used again") {
  Graph graph;
  NodeId sum = parameter(graph, 0);
  for (std::uint32_t k = 1; k < 40; ++k)
    sum = graph.make(Op::Add, graph.make(Op::Sqrt, sum), parameter(graph, k));
  const compile::Kernel kernel = compile::compile_kernel(graph, std::span(&sum, 1));
  CHECK(kernel.doubles == 2 * kernel.lanes);
}

TEST_CASE("the origin of a number that is not finite is the operation that made it") {
  Graph graph;
  const auto span = [](std::uint32_t at) { return support::Span{{}, at, at + 1}; };
  const NodeId x = parameter(graph, 0), y = parameter(graph, 1);
  const NodeId inside = graph.make(Op::Sub, x, y, compile::ir::kNone, 0, span(10));
  const NodeId root =
      graph.make(Op::Log, inside, compile::ir::kNone, compile::ir::kNone, 0, span(20));
  const NodeId scaled =
      graph.make(Op::Scale, root, position(graph, 0), compile::ir::kNone, 0, span(30));
  const NodeId choice =
      graph.make(Op::Select, graph.make(Op::Less, x, y), position(graph, 0), scaled);
  const NodeId roots[] = {x, choice};
  const compile::Kernel kernel = compile::compile_kernel(graph, roots);
  REQUIRE(kernel.inputs.size() == 3);
  engine::KernelScratch scratch;
  // Inputs by number: x, y, position.
  OneMatch finite{{{2}, {1}, {1, 2, 3}}}, unused{{{1}, {2}, {1, 2, 3}}};
  OneMatch zero{{{2}, {2}, {1, 2, 3}}}, bad{{{2}, {1}, {1, INFINITY, 3}}};
  CHECK_FALSE(engine::locate_non_finite(kernel, finite.bindings(kernel), 0, scratch));
  CHECK_FALSE(engine::locate_non_finite(kernel, unused.bindings(kernel), 0, scratch));
  const auto log = engine::locate_non_finite(kernel, zero.bindings(kernel), 0, scratch);
  REQUIRE(log);
  CHECK(log->output == 1);
  CHECK(log->op == KernelOp::Log);
  CHECK(log->span == span(20));
  CHECK_FALSE(log->input);
  const auto input = engine::locate_non_finite(kernel, bad.bindings(kernel), 0, scratch);
  REQUIRE(input);
  CHECK(input->op == KernelOp::Gather);
  CHECK(input->input == 2u);
}

TEST_CASE("only finite results pass, wherever in a block") {
  Graph graph;
  const NodeId number = parameter(graph, 0), vector = position(graph, 0);
  const NodeId root = graph.make(Op::Scale, number, vector);
  const compile::Kernel kernel = compile::compile_kernel(graph, std::span(&root, 1));
  REQUIRE(kernel.inputs.size() == 2);
  const std::uint32_t matches = 150;
  engine::KernelScratch scratch;
  for (const engine::Isa isa : engine::available_isas()) {
    for (std::uint32_t at = 0; at < matches; ++at) {
      std::vector<double> factor(matches, 1.0), vectors(3 * matches, 2.0), out(3 * matches);
      factor[at] = at % 2 == 0 ? INFINITY : NAN;
      const engine::InputBinding in[] = {{factor.data(), 1, nullptr, true},
                                         {vectors.data(), 3, nullptr, true}};
      const engine::OutputBinding to[] = {{out.data(), 3}};
      REQUIRE(engine::run_kernel(kernel, in, to, 0, matches, scratch, isa) == std::optional(at));
    }
  }
}
