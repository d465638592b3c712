// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "gmap/mesh.h"

namespace gmsim::gmap {

/// Length, area or volume of a cell, in the unit of the points. A polygon that is not plane has the
/// area of its vector area, a solid with warped facets the volume inside cones over their means.
[[nodiscard]] double cell_measure(const Mesh& mesh, std::size_t cell);
/// The same, negative for solids whose corners turn the wrong way.
[[nodiscard]] double signed_cell_measure(const Mesh& mesh, std::size_t cell);
/// Largest distance of a corner from the first.
[[nodiscard]] double cell_extent(const Mesh& mesh, std::size_t cell);

}  // namespace gmsim::gmap
