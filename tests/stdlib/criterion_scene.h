// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/simulation.h"
#include "unit/scene/scene_files.h"

namespace gmsim::test {

/// A scene from text, ready to step. `rules` goes to `my.rule` beside it, which the scene may name
/// under `rules: [./my.rule]`. Throws std::runtime_error with what the program says.
class CriterionScene {
 public:
  using Files = std::vector<std::pair<std::string, std::string>>;  ///< name and text
  explicit CriterionScene(const std::string& text, const std::string& rules = "",
                          const Files& files = {});

  [[nodiscard]] engine::Simulation& simulation() { return *simulation_; }
  [[nodiscard]] scene::Scene& scene() { return *loaded_->scene; }
  [[nodiscard]] engine::State& state() { return *loaded_->scene->state; }
  /// Value over threshold at every match of the first line of `tear`, in no particular order.
  [[nodiscard]] std::vector<double> ratios();
  /// One step of the scene.
  engine::StepReport step();
  /// Of a stored number over all its orbits.
  [[nodiscard]] double sum(const std::string& embedding) const { return loaded_->sum(embedding); }
  [[nodiscard]] std::string said() const { return loaded_->rendered(); }

 private:
  SceneFolder folder_;
  std::unique_ptr<LoadedScene> loaded_;
  std::unique_ptr<engine::Simulation> simulation_;
};

}  // namespace gmsim::test
