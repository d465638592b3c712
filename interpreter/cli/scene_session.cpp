// SPDX-License-Identifier: MIT
#include "cli/scene_session.h"

#include <fmt/format.h>

namespace gmsim::cli {
namespace {

/// What a scene may say and a run cannot do yet.
bool is_supported(Session& session, const scene::Scene& scene) {
  const auto refuse = [&](const support::Span& place, const char* key) {
    session.diagnostics.report({.kind = support::DiagnosticKind::Usage,
                                .message = fmt::format("`{}` is not supported yet", key),
                                .place = place,
                                .help = "leave it out to run the scene without it"});
  };
  for (const engine::TearPairing& tear : scene.tears) refuse(tear.span, "tear");
  for (const engine::StandingRewrite& rewrite : scene.rewrites) refuse(rewrite.span, "rewrite");
  return scene.tears.empty() && scene.rewrites.empty();
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
  if (!is_supported(session, scene)) return nullptr;
  engine::SimulationOptions options;
  options.threads = session.options.run.threads;
  options.tree_kernel = session.options.run.tree_kernel;
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
