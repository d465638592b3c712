// SPDX-License-Identifier: MIT
#pragma once

#include <yaml-cpp/yaml.h>

#include "gmap/mesh.h"
#include "support/diagnostic.h"

namespace gmsim::test {

/// The mesh of a test block: text as on the command line, or a map with points, cells and, for
/// solids, `dimension: 3`. Throws std::runtime_error when there is none.
[[nodiscard]] gmap::Mesh mesh_of(const YAML::Node& node, support::Diagnostics& diagnostics);

}  // namespace gmsim::test
