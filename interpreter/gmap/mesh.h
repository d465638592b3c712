// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
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
  std::vector<std::uint32_t> cell_points;       ///< corners of all cells, one after another
  std::vector<std::uint32_t> cell_begin = {0};  ///< cell c is cell_points[cell_begin[c] .. cell_begin[c+1])
  std::vector<CellKind> kinds;                  ///< one per cell
  std::vector<std::int32_t> regions;            ///< physical group of each cell, or empty
  std::vector<std::string> region_names;        ///< name of group i, or empty

  void add_cell(CellKind kind, const std::vector<std::uint32_t>& corners);
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
};

/// Builds the map of a mesh of any of the three dimensions: darts cell by cell in file order, facets shared by two cells sewn
/// in dimension n. Polygons are taken as they come: a generalized map needs no orientation.
/// Solids of negative volume are turned round and reported. A facet of more than two cells, a cell
/// that repeats a point or has no measure, and pinched edges are named with their numbers.
/// Nothing is built when a problem is fatal.
[[nodiscard]] MeshMap build_map(const Mesh& mesh);

}  // namespace gmsim::gmap
