// SPDX-License-Identifier: MIT
#pragma once

#include "scene/yaml_tree.h"
#include "support/diagnostic.h"
#include "support/source_map.h"

namespace gmsim::scene {

/// Compares a scene with the schema: unknown and missing keys, forms, numbers, units, choices, each
/// reported where it stands. Fills in what the schema gives by default and takes out what is wrong,
/// so that what is left can be read without asking again.
void validate_scene(YamlNode& scene, support::SourceMap& sources,
                    support::Diagnostics& diagnostics);

/// A number of a validated scene, in SI; what the schema's bounds allow.
[[nodiscard]] double number_of(const YamlNode& node, support::SourceMap& sources);

/// Words that older YAML takes for true or false, and people write.
[[nodiscard]] bool looks_boolean(const YamlNode& node);

}  // namespace gmsim::scene
