// SPDX-License-Identifier: MIT
#include "stdlib/criterion_scene.h"

#include <stdexcept>

namespace gmsim::test {

CriterionScene::CriterionScene(const std::string& text, const std::string& rules,
                               const Files& files) {
  for (const auto& [name, content] : files) folder_.write(name, content);
  if (!rules.empty()) folder_.write("my.rule", rules);
  loaded_ = std::make_unique<LoadedScene>(folder_.write("scene.yaml", text));
  if (!loaded_->scene) throw std::runtime_error(said());
  scene::Scene& scene = *loaded_->scene;
  simulation_ = engine::Simulation::create(*scene.state, scene.model, scene.integrator, {},
                                           loaded_->diagnostics);
  if (!simulation_) throw std::runtime_error(said());
}

std::vector<double> CriterionScene::ratios() {
  const auto reports = simulation_->survey(loaded_->diagnostics);
  if (!reports) throw std::runtime_error(said());
  return reports->at(0).ratios;
}

engine::StepReport CriterionScene::step() {
  const auto report = simulation_->step(1e30, loaded_->diagnostics);
  if (!report) throw std::runtime_error(said());
  return *report;
}

}  // namespace gmsim::test
