// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "gmap/mesh.h"

namespace gmsim::gmap {

/// How the patches of a grid are filled.
enum class GridCells {
  Quads,
  Triangles,  ///< every patch cut by the diagonal from its lower left to its upper right corner
  Tri4,       ///< every patch a cone of four triangles with a point in its middle
  Mix2,       ///< patches with (i + j) odd as two triangles, the others as quads
  Mix4        ///< patches with (i + j) odd as four triangles, the others as quads
};

/// nx x ny patches over [0, width] x [0, height] in the plane z = 0. Grid point (i, j) is number
/// j (nx + 1) + i; middle points follow, in order of their patches.
[[nodiscard]] Mesh grid(std::uint32_t nx, std::uint32_t ny, double width, double height,
                        GridCells cells);

enum class BoxElements { Hexes, Tets6, Tets5 };

/// nx x ny x nz cells over the box; point (i, j, k) is number (k (ny + 1) + j)(nx + 1) + i.
/// Tets6: six tetrahedra around the diagonal of each cell; Tets5: five, mirrored from cell to cell.
[[nodiscard]] Mesh box(std::array<std::uint32_t, 3> cells, std::array<double, 3> size,
                       BoxElements elements);

/// A chain of `segments` segments along x: a 1-map.
[[nodiscard]] Mesh chain(std::uint32_t segments, double length);

}  // namespace gmsim::gmap
