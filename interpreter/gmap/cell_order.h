// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "gmap/mesh.h"

namespace gmsim::gmap {

/// An order of the cells in which neighbours stand close together, for build_map(): darts, and with
/// them the rows of all orbits, follow it, so that what is read together lies together in memory.
/// Cells along a Morton curve through their centres. Empty where the order of the mesh is as good,
/// or the mesh is too small for it to matter, or its points and corners are not in order.
[[nodiscard]] std::vector<std::uint32_t> cell_order(const Mesh& mesh);

}  // namespace gmsim::gmap
