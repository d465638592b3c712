// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "scene/yaml_tree.h"
#include "support/diagnostic.h"
#include "support/source_map.h"

namespace gmsim::scene {

/// Puts the values of `--set PATH=VALUE` into a scene, in order, before it is validated. The steps
/// of a path are keys; an entry of a list is named by its `name`, by its only key
/// (`loads.vertex_drag.coefficient`) or by its number, from 0. Keys that are not there are added:
/// whether a scene may hold them is for the schema to say.
void apply_overrides(YamlNode& scene, const std::vector<std::string>& overrides,
                     support::SourceMap& sources, support::Diagnostics& diagnostics);

}  // namespace gmsim::scene
