// SPDX-License-Identifier: MIT
// Forces after changes of the map: kept up to date here and there they equal forces made anew.
#include <doctest/doctest.h>

#include <cstring>

#include "engine/map_delta.h"
#include "engine/rewrite.h"
#include "force_world.h"
#include "gmap/mesh_builders.h"

using namespace gmsim;
using namespace gmsim::tests;

namespace {

bool any(const compile::InteractionBody&) { return true; }
std::unique_ptr<engine::ForceField> kernel_forces(ForceWorld& world, const engine::Model& model) {
  support::Diagnostics diagnostics;
  auto forces = engine::make_kernel_forces(world.state(), model, 1, diagnostics);
  REQUIRE_MESSAGE(forces, diagnostics.all().front().message);
  return forces;
}

void compare(engine::ForceField& kept, engine::ForceField& anew, ForceWorld& world) {
  const engine::Motion motion = world.motion();
  Records a(motion.position.size()), b(motion.position.size());
  REQUIRE(kept.evaluate(motion, 0, 1e-3, a));
  REQUIRE(anew.evaluate(motion, 0, 1e-3, b));
  REQUIRE(std::memcmp(a.data(), b.data(), a.size() * sizeof(VertexRecord)) == 0);
  double energy = 0, other = 0;
  REQUIRE(kept.potential_energy(motion, 0, energy));
  REQUIRE(anew.potential_energy(motion, 0, other));
  REQUIRE(energy == other);
}

/// Cuts the facet of a dart.
void separate(ForceWorld& world, engine::Rewriter& rewriter, types::DartId dart,
              engine::ForceField& forces) {
  const compile::Rule* rule = world.program().find_rule("separate_elements");
  REQUIRE(rule != nullptr);
  const engine::RewriteOutcome outcome = rewriter.apply(*rule, {&dart, 1});
  REQUIRE(outcome.applied());
  forces.refresh(engine::map_delta(world.state(), outcome.effects).darts);
  REQUIRE_MESSAGE(!forces.error(), forces.error()->message);
}

/// Cuts random facets, refreshing after each cut.
void tear(ForceWorld& world, const engine::Model& model, std::uint32_t seed, int cuts) {
  const auto kept = kernel_forces(world, model);
  engine::Rewriter rewriter(world.state());
  std::mt19937 random(seed);
  const int top = world.program().dimension;
  for (int cut = 0; cut < cuts; ++cut) {
    CAPTURE(cut);
    const types::DartId dart{static_cast<std::uint32_t>(random() % world.state().map.dart_end())};
    if (!world.state().map.alive(dart) || world.state().map.alpha(top, dart) == dart) continue;
    separate(world, rewriter, dart, *kept);
    compare(*kept, *kernel_forces(world, model), world);
  }
}

}  // namespace

TEST_CASE("interactions of the library are repaired match by match") {
  for (const gmap::Mesh& mesh : {gmap::grid(2, 2, 2, 2, gmap::GridCells::Mix2),
                                 gmap::box({2, 1, 1}, {2, 1, 1}, gmap::BoxElements::Hexes)}) {
    ForceWorld world(mesh, 1);
    const std::string plan = kernel_forces(world, model_of(world.program(), false, any))->explain();
    CAPTURE(plan);
    CHECK(plan.find("found anew") == std::string::npos);
  }
}

TEST_CASE("each interaction by itself survives cuts") {
  std::uint32_t seed = 100;
  for (const gmap::Mesh& mesh : {gmap::grid(3, 3, 3, 3, gmap::GridCells::Mix2),
                                 gmap::box({2, 2, 1}, {2, 2, 1}, gmap::BoxElements::Hexes)}) {
    for (std::uint32_t i = 0; i < ForceWorld(mesh, 1).program().interactions.size(); ++i) {
      ForceWorld world(mesh, ++seed);
      const std::string name = world.program().interactions[i].name;
      CAPTURE(name);
      tear(world, model_of(world.program(), seed % 2 == 0,
                           [&](const auto& body) { return body.name == name; }),
           seed, 12);
    }
  }
}

TEST_CASE("after each cut the forces equal those made anew, bit by bit") {
  std::uint32_t seed = 0;
  for (const gmap::Mesh& mesh : {gmap::grid(4, 4, 4, 4, gmap::GridCells::Mix2),
                                 gmap::grid(3, 3, 3, 3, gmap::GridCells::Tri4),
                                 gmap::box({2, 2, 2}, {2, 2, 2}, gmap::BoxElements::Hexes),
                                 gmap::box({2, 1, 1}, {2, 1, 1}, gmap::BoxElements::Tets5)}) {
    for (const bool uniform : {false, true}) {
      CAPTURE(seed);
      ForceWorld world(mesh, ++seed);
      tear(world, model_of(world.program(), uniform, any), seed, 25);
    }
  }
}

TEST_CASE("a vertex that splits off is summed while its forces are there, on meshes of many pieces") {
  ForceWorld world(gmap::grid(44, 44, 1, 1, gmap::GridCells::Quads), 7);
  const engine::Model model = model_of(world.program(), true, [](const auto& body) {
    return body.name == "stretch_spring" || body.name == "linear_shear_spring";
  });
  const gmap::GMap& map = world.state().map;
  engine::Rewriter rewriter(world.state());
  const auto kept = kernel_forces(world, model);
  compare(*kept, *kept, world);
  // Cuts all edges around some vertices, here and there in the mesh: each comes apart into four.
  std::uint32_t split = 0;
  for (std::uint32_t k = 1; k < 8; ++k) {
    CAPTURE(k);
    types::DartId dart{k * map.dart_end() / 9};
    for (int edge = 0; edge < 4; ++edge) {
      if (map.alpha(2, dart) == dart) break;
      const types::DartId next = map.alpha(1, map.alpha(2, dart));
      const std::size_t before = world.motion().position.size();
      separate(world, rewriter, dart, *kept);
      split += static_cast<std::uint32_t>(world.motion().position.size() - before);
      dart = next;
    }
    compare(*kept, *kernel_forces(world, model), world);
  }
  CHECK(split >= 12);
}
