// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "io/mesh_frame.h"

namespace gmsim::io {

/// What is drawn of a mesh: its visible surface as triangles and edges, its lines and single
/// vertices. Points and cells that nothing drawn belongs to are left out; the others are numbered
/// anew, and `points` and `cells` say which they are in the mesh.
struct ViewMesh {
  std::size_t all_points = 0, all_cells = 0;  ///< of the mesh
  std::vector<std::uint32_t> points, cells;
  std::vector<std::uint32_t> triangles, triangle_cells;  ///< three points each
  /// Two points each: sides of the polygons (not of their triangles). Those that only one polygon
  /// has come first: the outline of a sheet and of its tears.
  std::vector<std::uint32_t> edges;
  std::size_t outline_edges = 0;
  std::vector<std::uint32_t> lines, line_cells;  ///< two points each
  std::vector<std::uint32_t> dots, dot_cells;    ///< one point each
};

/// `points` decide how polygons are cut into triangles.
[[nodiscard]] ViewMesh view_mesh(const MeshTopology& topology,
                                 std::span<const std::array<double, 3>> points);

}  // namespace gmsim::io
