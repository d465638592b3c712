// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gmap/gmap.h"

namespace gmsim::gmap {

/// A mesh as files and builders hold it: points and cells of point numbers.
/// dimension 1: every cell is a segment {a, b}. dimension 2: every cell is a polygon, its corners
/// in order. dimension 3: `kinds` says which solid a cell is.
struct Mesh {
  /// Corner order as in VTK: Wedge (prism) 0-2 bottom, 3-5 top; Pyramid 0-3 base, 4 apex;
  /// Hexahedron 0-3 bottom, 4-7 top.
  enum class CellKind : std::uint8_t { Segment, Polygon, Tetrahedron, Hexahedron, Prism, Pyramid };

  int dimension = 2;
  std::vector<std::array<double, 3>> points;
  std::vector<std::uint32_t> cell_points;  ///< corners of all cells, one after another
  std::vector<std::uint32_t> cell_begin = {
      0};                             ///< cell c is cell_points[cell_begin[c] .. cell_begin[c+1])
  std::vector<CellKind> kinds;        ///< one per cell
  std::vector<std::int32_t> regions;  ///< physical group of each cell, or empty
  std::vector<std::string> region_names;  ///< name of group i, or empty

  void add_cell(CellKind kind, const std::vector<std::uint32_t>& corners);
  [[nodiscard]] std::span<const std::uint32_t> corners(std::size_t cell) const {
    return std::span(cell_points)
        .subspan(cell_begin[cell], cell_begin[cell + 1] - cell_begin[cell]);
  }
  [[nodiscard]] std::size_t cell_count() const { return kinds.size(); }
};

/// Something odd about a mesh that does not prevent building it (an unused point, a cell turned
/// round), or does (a face of three volumes, a degenerate cell).
struct MeshProblem {
  bool fatal = false;
  std::string message;
};

/// A map built from a mesh.
struct MeshMap {
  GMap map{2};
  /// For each point of the mesh the smallest dart of its (first) vertex; kNoDart when unused.
  std::vector<DartId> point_dart;
  /// For each dart the point it sits on, and the cell it belongs to.
  std::vector<std::uint32_t> dart_point;
  std::vector<std::uint32_t> dart_cell;
  std::vector<MeshProblem> problems;

  /// True when a problem is fatal: the map is empty then.
  [[nodiscard]] bool failed() const;
};

/// Builds the map of a mesh of any of the three dimensions: darts cell by cell, in the order of the
/// mesh or in `order` (all cells, each once), facets shared by two cells sewn in dimension n. Polygons are taken as they come: a generalized
/// map needs no orientation, and a mesh may be non-orientable.
///
/// Darts of a polygon: 2c at corner c and 2c + 1 at corner c + 1 for its edge c. A solid is its
/// facets one after another, each like a polygon; the first facet is the base, so the first dart
/// of a cell sits on its corner 0 and its 0-link leads to corner 1 (in a tetrahedron, d, d@0,
/// d@1@0, d@2@1@0 are corners 0, 1, 2, 3).
///
/// Solids of negative volume (base seen clockwise from the rest) are turned round, by mirroring the
/// order of their corners around corner 0, and reported. Unused points are reported and have no
/// dart. Where the cells around a point or a 3D edge do not hang together by facets (a pinched
/// vertex or edge), each part becomes a vertex or edge of its own, which is reported too. Fatal are
/// a wrong number of corners, a point number beyond the last, a coordinate that is not finite, a
/// cell that repeats a point or has no measure (below 1e-13 of its extent to the power of the
/// dimension), and a facet of more than two cells. Every message names what it speaks of by number,
/// the first ten. Nothing is built when a problem is fatal.
[[nodiscard]] MeshMap build_map(const Mesh& mesh, std::span<const std::uint32_t> order = {});

}  // namespace gmsim::gmap
