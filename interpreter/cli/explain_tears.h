// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>

#include "engine/simulation.h"
#include "scene/scene.h"
#include "support/diagnostic.h"

namespace gmsim::cli {

/// `--explain-tear`: for every line of `tear:` the match that came nearest to its threshold, where and
/// when, and how the matches are spread at the end.
void explain_tears(const scene::Scene& scene, engine::Simulation& simulation, std::ostream& out,
                   support::Diagnostics& diagnostics);

}  // namespace gmsim::cli
