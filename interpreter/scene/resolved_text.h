// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "scene/yaml_tree.h"

namespace gmsim::scene {

/// A validated scene as YAML again, with all that was filled in: reading it gives the same tree.
[[nodiscard]] std::string resolved_text(const YamlNode& scene);

}  // namespace gmsim::scene
