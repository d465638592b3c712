// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "gmap/mesh.h"
#include "support/diagnostic.h"

namespace gmsim::scene {

/// A mesh named on a command line: `grid:CELLS:NXxNY[:WxH]`, `box:CELLS:NXxNYxNZ[:LXxLYxLZ]`,
/// `chain:N[:LENGTH]`, or a file. Sizes default to 1 in each direction, in metres.
/// Empty after an error, which `diagnostics` then holds.
[[nodiscard]] std::optional<gmap::Mesh> mesh_from_spec(const std::string& spec,
                                                       support::Diagnostics& diagnostics);

}  // namespace gmsim::scene
