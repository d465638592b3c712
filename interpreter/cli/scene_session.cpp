// SPDX-License-Identifier: MIT
#include "cli/scene_session.h"

namespace gmsim::cli {

std::unique_ptr<scene::Scene> load_scene(Session& session, const std::vector<std::string>& more) {
  scene::SceneOptions options;
  options.overrides = session.options.run.overrides;
  options.overrides.insert(options.overrides.end(), more.begin(), more.end());
  options.library.stdlib_folder = session.options.stdlib_folder;
  return scene::load_scene(session.options.run.scene, options, session.sources,
                           session.diagnostics);
}

std::unique_ptr<engine::Simulation> make_simulation(Session& session, scene::Scene& scene) {
  engine::SimulationOptions options;
  options.threads = session.options.run.threads;
  options.tree_kernel = session.options.run.tree_kernel;
  options.follow_nearest = session.options.run.explain_tear;
  options.trace = &session.trace;
  return engine::Simulation::create(*scene.state, scene.model, scene.integrator, options,
                                    session.diagnostics);
}

double next_stop(const scene::Scene& scene, double time) {
  for (const double stop : scene.stop_at)
    if (stop > time && stop < scene.duration) return stop;
  return scene.duration;
}

}  // namespace gmsim::cli
