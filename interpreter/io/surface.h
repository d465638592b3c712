// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "io/mesh_frame.h"

namespace gmsim::io {

/// Polygons of point numbers, each with the cell it belongs to.
struct Surface {
  std::vector<std::int32_t> corners;
  std::vector<std::int32_t> begin = {0};  ///< one more than polygons
  std::vector<std::int32_t> cells;

  [[nodiscard]] std::size_t size() const { return cells.size(); }
  [[nodiscard]] std::span<const std::int32_t> polygon(std::size_t number) const;
};

/// What can be seen of a mesh: its polygons, and of its solids the faces that only one of them has,
/// turned outwards. Lines and vertices have no surface.
[[nodiscard]] Surface visible_surface(const MeshTopology& topology);

}  // namespace gmsim::io
