// SPDX-License-Identifier: MIT
#include "cli/scene_session.h"

#include "gmap/orbit_walk.h"

namespace gmsim::cli {
namespace {

/// The model with what tears and what is rewritten while it runs.
engine::Model full_model(const scene::Scene& scene) {
  engine::Model model = scene.model;
  model.tears = scene.tears;
  model.rewrites = scene.rewrites;
  const auto fixed = scene.program.schema.find("fixed");
  const engine::State& state = *scene.state;
  if (scene.on_split == engine::OnSplit::Both || !fixed || !state.store.in_use(*fixed)) return model;
  for (const gmap::DartId dart :
       gmap::all_orbits(state.map, types::OrbitType::cell(0, scene.program.dimension)))
    if (state.store.get(*fixed, dart)[0] != 0) model.holds.push_back({dart, scene.on_split});
  return model;
}

}  // namespace

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
  options.trace = &session.trace;
  return engine::Simulation::create(*scene.state, full_model(scene), scene.integrator, options,
                                    session.diagnostics);
}

double next_stop(const scene::Scene& scene, double time) {
  for (const double stop : scene.stop_at)
    if (stop > time && stop < scene.duration) return stop;
  return scene.duration;
}

}  // namespace gmsim::cli
