// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "gmap/gmap.h"
#include "gmap/orbit_index.h"
#include "io/mesh_frame.h"
#include "io/point_numbering.h"

namespace gmsim::io {

/// How volumes that VTK has no cell type for are written.
enum class PolyhedronStyle {
  Polyhedra,  ///< as VTK polyhedra
  Faces       ///< each face of such a volume as a polygon of its own, for readers without polyhedra
};

/// The position (m) of the vertex of a dart.
using DartPosition = std::function<std::array<double, 3>(gmap::DartId)>;

/// A map as a mesh, and where its points and cells come from.
struct MapFrame {
  MeshFrame mesh;
  std::vector<gmap::DartId> point_darts;  ///< smallest dart of each point's vertex
  std::vector<gmap::DartId> cell_darts;   ///< smallest dart of each cell (of its face: Faces)
};

/// The cells of a map's own dimension, ordered by smallest dart: edges as lines, faces as polygons,
/// volumes as tetrahedra, hexahedra, wedges and pyramids when they have exactly that structure,
/// else as polyhedra. Corners start at the smallest dart; solids are turned so that their volume is
/// positive here and now. Faces with a free link are written as the polygon through their corners.
/// `vertices` is the index of the vertex orbits that `numbering` was made from.
[[nodiscard]] MapFrame mesh_frame_from_map(const gmap::GMap& map, const gmap::OrbitIndex& vertices,
                                           const PointNumbering& numbering,
                                           const DartPosition& position,
                                           PolyhedronStyle style = PolyhedronStyle::Polyhedra);

}  // namespace gmsim::io
