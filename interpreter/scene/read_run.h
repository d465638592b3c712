// SPDX-License-Identifier: MIT
#pragma once

#include "scene/read_context.h"
#include "scene/scene.h"

namespace gmsim::scene {

/// How long, by which method, from which seed: what needs no rules.
void read_run(const YamlNode& tree, support::SourceMap& sources, support::Diagnostics& diagnostics,
              Scene& scene);
/// What is written.
void read_output(const YamlNode& tree, ReadContext& context, Scene& scene);
/// What is expected of the run; the points of `plan.expected` are looked up when there is a mesh.
void read_expectations(const YamlNode& tree, ReadContext& context, Scene& scene, ScenePlan& plan);

}  // namespace gmsim::scene
