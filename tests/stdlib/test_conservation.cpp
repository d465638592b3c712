// SPDX-License-Identifier: MIT
// The rules of the library conserve mass and momentum, whatever masses and velocities they meet.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <random>

#include "engine/operation.h"
#include "engine/rewrite.h"
#include "gmap/orbit_walk.h"
#include "stdlib/block_state.h"

namespace gmsim::test {
namespace {

using types::DartId;

/// A rule or operation, where to try it, and the meshes (YAML) to try it on.
struct Case {
  std::string name;
  std::string to;
  std::vector<std::string> meshes;
  std::string rules = "";
  std::vector<std::pair<std::string, std::string>> parameters = {};
};

const std::vector<std::string> kSurfaces = {"grid:quads:3x2", "grid:triangles:2x2", "grid:mix4:2x2"};
const std::vector<std::string> kSolids = {"box:hexes:2x2x1", "box:tets5:2x1x1", "box:tets6:1x1x1"};
const std::vector<std::string> kAll = {"chain:4",        "grid:quads:3x2",    "grid:mix2:2x2",
                                       "box:hexes:2x2x1", "box:tets6:1x1x1"};
const std::string kCube =
    "{ points: [[0,0,0], [1,0,0], [1,1,0], [0,1,0], [0,0,1], [1,0,1], [1,1,1], [0,1,1]], cells: "
    "[[0,1,2,3], [4,5,6,7], [0,1,5,4], [1,2,6,5], [2,3,7,6], [3,0,4,7]] }";

const std::vector<Case>& cases() {
  static const std::vector<Case> list = {
      {"separate_elements", "facet", kAll},
      {"insert_vertex", "edge", kAll},
      {"triangulate_face", "face", kSurfaces},
      {"triangulate_face", "face", kSolids},
      {"cone_volume", "volume", kSolids},
      {"split_quad", "face", {"grid:quads:3x2", "grid:mix2:2x2"}},
      {"flip_edge", "edge", {"grid:triangles:3x2", "grid:mix4:2x2"}},
      {"dual", "component", {kCube}},
      {"subdivide_quads", "component", kSurfaces},
      {"subdivide_triangles", "component", kSurfaces},
      {"subdivide_hexahedra", "component", kSolids},
      {"dissolve_edge", "edge", kSurfaces},
      {"dissolve_border_edge", "edge", {"box:hexes:1x1x1", "box:tets5:1x1x1"}},
      {"merge_volumes", "facet", kSolids},
      {"split_vertex", "vertex", kAll, "", {{"normal", "(0.3, 1, 0.2)"}}},
      {"split_edge_ends", "edge", kAll},
      {"cut_diagonal", "face", {"grid:quads:3x2", "box:hexes:2x1x1"},
       "operation cut_diagonal on face(a) { apply insert_edge(a, a@0@1@0); }"},
      {"there_and_back", "edge", kSurfaces,
       "operation there_and_back on edge(a) { apply insert_vertex(a); "
       "if free(a, 2) { apply remove_border_vertex(a@0); } else { apply remove_vertex(a@0); } }"},
      {"cut_and_weld", "facet", kAll,
       "operation cut_and_weld on facet(a) { let b = a@n; apply separate_elements(a); "
       "apply weld_elements(a, b); }"},
  };
  return list;
}

TestBlock block_of(const Case& c, const std::string& mesh, std::uint32_t seed) {
  YAML::Node yaml;
  yaml["mesh"] = YAML::Load(mesh);
  if (!c.rules.empty()) yaml["rules"] = c.rules;
  TestBlock block{"conservation", static_cast<int>(seed), yaml};
  return block;
}

/// Uneven masses, velocities and positions.
void shake(BlockState& state, std::uint32_t seed) {
  const auto noise = [&](int k, const char* orbit) {
    return fmt::format("(random({}, {}(a)) - 0.5)", 10 * seed + static_cast<std::uint32_t>(k), orbit);
  };
  state.set("position", fmt::format("position + 0.1 [m] * ({}, {}, {})", noise(1, "vertex"),
                                    noise(2, "vertex"), noise(3, "vertex")));
  state.set("velocity", fmt::format("4 [m/s] * ({}, {}, {})", noise(4, "vertex"),
                                    noise(5, "vertex"), noise(6, "vertex")));
  state.set("corner_mass", fmt::format("1 [kg] + 1.5 [kg] * {}", noise(7, "corner")));
}

/// Mass, then momentum.
std::array<double, 4> totals(BlockState& state) {
  const std::string sum = "sum(v in all vertex : v.mass";
  const auto momentum = state.value(sum + " * v.velocity)", DartId{0});
  return {state.value(sum + ")", DartId{0})[0], momentum[0], momentum[1], momentum[2]};
}

/// Applies at a random half of the candidates; the number of rules applied.
std::uint64_t apply_somewhere(const Case& c, BlockState& state, std::mt19937& random) {
  std::vector<DartId> darts;
  for (const DartId dart : gmap::all_orbits(state.state().map, state.orbit(c.to)))
    if (c.to == "component" || random() % 2 == 0) darts.push_back(dart);
  engine::Rewriter rewriter(state.state(), {.validate = true});
  const compile::Rule* rule = state.program().find_rule(c.name);
  const compile::Operation* operation = state.program().find_operation(c.name);
  REQUIRE_MESSAGE((rule != nullptr || operation != nullptr), c.name);
  const compile::ItemHead& head = rule ? static_cast<const compile::ItemHead&>(*rule) : *operation;
  engine::Arguments arguments;
  for (const auto& [name, text] : c.parameters) {
    const compile::Parameter* parameter = head.find_parameter(name);
    types::Value value{.type = parameter->type};
    value.data = state.value(text, DartId{0}, parameter->type);
    arguments.emplace_back(parameter->slot, std::move(value));
  }
  const engine::RewriteOutcome outcome =
      rule ? rewriter.apply_each(*rule, darts, arguments)
           : engine::OperationRunner(rewriter).run_each(*operation, darts, arguments);
  CHECK_MESSAGE(!outcome.error, c.name, ": ", outcome.error ? outcome.error->message : "");
  return outcome.effects.applications;
}

TEST_CASE("mass and momentum stay whatever is rewritten") {
  const std::uint32_t seed = std::random_device{}() % 100000;
  INFO("seed ", seed);
  std::mt19937 random(seed);
  for (const Case& c : cases()) {
    std::uint64_t applied = 0;
    for (const std::string& mesh : c.meshes) {
      for (std::uint32_t round = 0; round < 2; ++round) {
        BlockState state(block_of(c, mesh, seed));
        shake(state, seed + round);
        const auto before = totals(state);
        applied += apply_somewhere(c, state, random);
        const auto after = totals(state);
        for (std::size_t k = 0; k < 4; ++k)
          CHECK_MESSAGE(std::abs(after[k] - before[k]) <= 1e-12 * before[0], c.name, " on ", mesh,
                        k == 0 ? ": mass " : ": momentum ", before[k], " -> ", after[k]);
      }
    }
    CHECK_MESSAGE(applied > 0, c.name, " was never applied");
  }
}

TEST_CASE("the check notices a rule that loses mass") {
  const Case leak{"leak", "edge", {"grid:quads:2x2"},
                  "rule leak(a) { left { a<0,2..n>; } right { a<_,2..n> -0- m<1,2..n>; } "
                  "m.position = 0.5 * (a.position + a@0.position); m.corner_mass = 0; "
                  "a.corner_mass = 0.5 * a.corner_mass; }"};
  std::mt19937 random(1);
  BlockState state(block_of(leak, leak.meshes[0], 1));
  const double before = totals(state)[0];
  CHECK(apply_somewhere(leak, state, random) > 0);
  CHECK(totals(state)[0] < 0.99 * before);
}

}  // namespace
}  // namespace gmsim::test
