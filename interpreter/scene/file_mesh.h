// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gmap/mesh.h"
#include "scene/import_mesh.h"
#include "support/diagnostic.h"

namespace gmsim::scene {

using CellKind = gmap::Mesh::CellKind;

/// 1 for segments, 2 for polygons, 3 for solids.
[[nodiscard]] int dimension_of(CellKind kind);

/// Values a file gives for some points or cells: row i belongs to number `rows[i]`.
struct FileColumn {
  std::string name;
  std::uint32_t components = 1;
  std::vector<std::size_t> rows;
  std::vector<double> values;
};

/// Everything a mesh file holds, before the cells of one dimension are chosen.
struct FileMesh {
  std::vector<std::array<double, 3>> points;
  std::vector<CellKind> kinds;
  std::vector<std::uint32_t> corners;    ///< of all cells, one after another
  std::vector<std::size_t> begin = {0};  ///< as gmap::Mesh::cell_begin
  std::vector<std::int32_t> regions;     ///< one per cell; 0: none
  std::size_t point_cells = 0;           ///< cells of dimension 0, never kept
  std::map<std::pair<int, std::int32_t>, std::string> region_names;  ///< by (dimension, number)
  std::vector<FileColumn> point_data, cell_data;
  std::vector<std::string> warnings;

  [[nodiscard]] std::size_t cell_count() const { return kinds.size(); }
  [[nodiscard]] std::size_t corner_count(std::size_t cell) const {
    return begin[cell + 1] - begin[cell];
  }
  /// Ends the cell whose corners were appended to `corners`.
  void close_cell(CellKind kind, std::int32_t region);
};

/// What is wrong with the bytes of a mesh file, and where. Thrown inside this module only.
struct MeshFileError {
  std::string message;
  std::optional<std::size_t> line;  ///< 1-based, text files
  std::optional<std::size_t> byte;  ///< binary files
};

/// Readers of one format each; `bytes` is the whole file. Throw MeshFileError.
[[nodiscard]] FileMesh read_msh(std::string_view bytes);
[[nodiscard]] FileMesh read_obj(std::string_view bytes);

/// Keeps the cells of one dimension. `file` names the mesh in messages.
[[nodiscard]] std::optional<ImportedMesh> select_cells(FileMesh mesh,
                                                       const MeshImportOptions& options,
                                                       const std::string& file,
                                                       support::Diagnostics& diagnostics);

}  // namespace gmsim::scene
