// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/session.h"
#include "engine/simulation.h"
#include "scene/scene.h"

/// What the commands that run scenes share.
namespace gmsim::cli {

/// Loads the scene of the command line with its overrides and `more`. Null after an error, which
/// is reported.
[[nodiscard]] std::unique_ptr<scene::Scene> load_scene(Session& session,
                                                       const std::vector<std::string>& more = {});

/// A simulation of the scene as the command line wants it. Null after an error, which is reported.
[[nodiscard]] std::unique_ptr<engine::Simulation> make_simulation(Session& session,
                                                                  scene::Scene& scene);

/// Where the next step must end at the latest (s): at a time that the scene wants steps to end at,
/// or at its end.
[[nodiscard]] double next_stop(const scene::Scene& scene, double time);

}  // namespace gmsim::cli
