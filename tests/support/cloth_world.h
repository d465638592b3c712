// SPDX-License-Identifier: MIT
// A cloth of the standard library's springs, as a scene would set it up, for tests of whole runs.
#pragma once

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "check/check.h"
#include "compile/compile.h"
#include "engine/enumerate.h"
#include "engine/simulation.h"
#include "engine/state.h"
#include "engine/tree_eval.h"
#include "gmap/mesh_builders.h"

namespace gmsim::tests {

/// n x n patches of 1 m^2 and 0.1 kg; stretch 60, shear 43, bending 10 N/m, every spring with the
/// same damping; gravity 9.81 m/s^2 along -z. Point j (n + 1) + i as the grid numbers them.
class ClothWorld {
 public:
  ClothWorld(std::uint32_t patches, gmap::GridCells cells, double damping,
             const std::vector<std::uint32_t>& fixed_points)
      : mesh_(gmap::grid(patches, patches, 1, 1, cells)),
        rules_(check::check_texts({}, {}, sources, diagnostics)),
        program_(compile::compile_program(rules_.in(2))),
        built_(gmap::build_map(mesh_)),
        state(program_, built_.map) {
    REQUIRE_MESSAGE(!diagnostics.has_errors(), diagnostics.all().front().message);
    state.use_data();
    for (std::size_t p = 0; p < mesh_.points.size(); ++p)
      state.store.set(id("position"), built_.point_dart[p], mesh_.points[p]);
    weigh();
    const double yes = 1;
    for (const std::uint32_t p : fixed_points)
      state.store.set(id("fixed"), built_.point_dart[p], {&yes, 1});
    add("stretch_spring", {{"stiffness", 60}, {"damping", damping}});
    if (cells == gmap::GridCells::Quads)
      add("linear_shear_spring", {{"stiffness", 43}, {"damping", damping}});
    add("linear_bending_spring", {{"stiffness", 10}, {"damping", damping}});
    add("gravity", {{"g", -9.81}});
  }

  [[nodiscard]] std::unique_ptr<engine::Simulation> simulate(
      const engine::IntegratorSettings& settings, bool tree_kernel = false) {
    return engine::Simulation::create(state, model, settings, {.tree_kernel = tree_kernel},
                                      diagnostics);
  }
  /// Steps to `end` and puts the result into the state.
  void run(engine::Simulation& simulation, double end) {
    while (simulation.time() < end)
      REQUIRE_MESSAGE(simulation.step(end, diagnostics).has_value(), messages());
    simulation.sync();
  }
  [[nodiscard]] std::array<double, 3> position(std::uint32_t point) const {
    const auto x = state.store.get(id("position"), built_.point_dart[point]);
    return {x[0], x[1], x[2]};
  }
  /// Largest distance of a point from where it should be.
  [[nodiscard]] double error(const std::vector<std::array<double, 3>>& reference) const {
    double worst = 0;
    for (std::uint32_t p = 0; p < reference.size(); ++p) {
      const auto x = position(p);
      worst = std::max(worst, std::hypot(x[0] - reference[p][0], x[1] - reference[p][1],
                                         x[2] - reference[p][2]));
    }
    return worst;
  }
  [[nodiscard]] types::EmbeddingId id(const std::string& name) const {
    return program_.schema.find(name).value();
  }
  [[nodiscard]] std::string messages() const {
    std::string text;
    for (const support::Diagnostic& d : diagnostics.all()) {
      text += d.message + "\n";
      for (const std::string& note : d.notes) text += "  note: " + note + "\n";
    }
    return text;
  }

  support::SourceMap sources;
  support::Diagnostics diagnostics;
  engine::Model model;

 private:
  using Given = std::vector<std::pair<std::string, double>>;

  /// Mass in proportion to area; all cells of a grid have as much.
  void weigh() {
    auto& column = state.store.column(id("corner_mass"));
    for (gmap::Row row = 0; row < column.row_end(); ++row)
      column.set(row, std::array{0.1 / column.row_end()});
  }

  /// The interaction everywhere its pattern holds: given parameters uniform, the others from their
  /// defaults at each match.
  void add(const std::string& name, const Given& given) {
    std::uint32_t number = 0;
    while (program_.interactions[number].name != name) ++number;
    const compile::RootedPattern& item = program_.interactions[number];
    const compile::InteractionBody& body = program_.interaction_bodies[number];
    engine::ActiveInteraction active{.interaction = number, .parameters = {}, .span = {}};
    state.use(*item.presence);
    for (const compile::BodyParameter& parameter : body.parameters) {
      engine::ParameterBinding binding{.embedding = *parameter.embedding, .uniform = {},
                                       .expression = {}};
      binding.kind = engine::ParameterBinding::Kind::Stored;
      for (const auto& [key, value] : given)
        if (key == parameter.name) {
          binding.kind = engine::ParameterBinding::Kind::Uniform;
          binding.uniform = {parameter.type, key == "g" ? std::vector<double>{0, 0, value}
                                                        : std::vector<double>{value}};
        }
      if (binding.kind == engine::ParameterBinding::Kind::Stored) state.use(*parameter.embedding);
      active.parameters.push_back(std::move(binding));
    }
    engine::Matcher matcher(state);
    engine::TreeEvaluator evaluator(state);
    const auto problem = engine::for_each_match(
        matcher, state, item.match, item.frame_size, {},
        {.orbit = item.orbit, .first = item.first.get(), .first_dart = item.first_dart},
        [&](types::DartId dart, const engine::Match&, engine::Frame& frame) {
          const double yes = 1;
          state.store.set(*item.presence, dart, {&yes, 1});
          for (std::size_t i = 0; i < body.parameters.size(); ++i) {
            if (active.parameters[i].kind != engine::ParameterBinding::Kind::Stored) continue;
            std::vector<double> value(types::component_count(body.parameters[i].type));
            REQUIRE(evaluator.evaluate(*body.parameters[i].default_value, frame, value));
            state.store.set(active.parameters[i].embedding, dart, value);
          }
        });
    REQUIRE_MESSAGE(!problem, problem->message);
    model.interactions.push_back(std::move(active));
  }

  gmap::Mesh mesh_;
  check::CheckedRules rules_;
  compile::Program program_;
  gmap::MeshMap built_;

 public:
  engine::State state;
};

}  // namespace gmsim::tests
