// SPDX-License-Identifier: MIT
// The cloth of a scene file as gmsim runs it, for benchmarks.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/yardstick.h"
#include "engine/simulation.h"
#include "scene/scene.h"

namespace gmsim::bench {

/// The cloth of a scene file with n by n patches.
class SceneCloth {
 public:
  /// `overrides`: what else is set, as after `--set`.
  SceneCloth(const std::string& file, std::uint32_t n, std::vector<std::string> overrides,
             unsigned threads = 1) {
    scene::SceneOptions options;
    options.overrides = std::move(overrides);
    options.overrides.push_back(fmt::format("bodies.cloth.mesh.grid.patches=[{}, {}]", n, n));
    scene_ = scene::load_scene(file, options, sources_, diagnostics_);
    if (scene_)
      simulation_ = engine::Simulation::create(*scene_->state, scene_->model, scene_->integrator,
                                               {.threads = threads}, diagnostics_);
    stop_on_errors();
  }
  /// With steps of dt.
  SceneCloth(const std::string& file, std::uint32_t n, double dt, unsigned threads = 1,
             std::vector<std::string> overrides = {})
      : SceneCloth(file, n, with_step(std::move(overrides), dt), threads) {}

  engine::StepReport step() {
    auto report = simulation_->step(1e9, diagnostics_);
    stop_on_errors();
    return std::move(*report);
  }
  [[nodiscard]] std::uint32_t darts() const { return scene_->state->map.dart_count(); }
  /// Value over threshold of everything that the first line of `tear` judges.
  std::vector<double> ratios() {
    const auto reports = simulation_->survey(diagnostics_);
    stop_on_errors();
    return reports->at(0).ratios;
  }
  /// Largest distance between its vertices and those of another cloth, as numbered by the scene.
  double distance(const bench::ClothStepper& other) {
    simulation_->sync();
    const auto position = *scene_->program.schema.find("position");
    double largest = 0;
    const auto& vertices = scene_->bodies.front().vertices;
    for (std::uint32_t k = 0; k < vertices.size(); ++k) {
      const auto here = scene_->state->store.get(position, vertices[k]);
      const auto there = other.position(k);
      for (int i = 0; i < 3; ++i) largest = std::max(largest, std::abs(here[i] - there[i]));
    }
    return largest;
  }

 private:
  static std::vector<std::string> with_step(std::vector<std::string> overrides, double dt) {
    overrides.push_back(fmt::format("integrator.dt={:.17g}", dt));
    return overrides;
  }
  void stop_on_errors() {
    for (const support::Diagnostic& diagnostic : diagnostics_.all())
      if (diagnostic.severity == support::Severity::Error) {
        fmt::print("{}\n", diagnostic.message);
        std::exit(2);
      }
  }

  support::SourceMap sources_;
  support::Diagnostics diagnostics_;
  std::unique_ptr<scene::Scene> scene_;
  std::unique_ptr<engine::Simulation> simulation_;
};

}  // namespace gmsim::bench
