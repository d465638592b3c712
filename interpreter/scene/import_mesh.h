// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gmap/mesh.h"
#include "support/diagnostic.h"

namespace gmsim::scene {

struct MeshImportOptions {
  int dimension = 0;  ///< 1, 2 or 3: cells of this dimension only; 0: the highest in the file
  bool keep_regions = true;  ///< physical groups (.msh) and groups or objects (.obj) become regions
  std::string python = {};   ///< interpreter that runs meshio; empty: looked for (meshio_bridge.h)
};

/// Values that a mesh file gives for every point or for every kept cell.
struct MeshColumn {
  std::string name;
  std::uint32_t components = 1;
  std::vector<double> values;  ///< components x rows, row after row
};

/// A physical group (.msh), group or object (.obj) of a mesh file, by its name; one without a name is
/// called `group N`.
struct MeshGroup {
  std::string name;
  std::vector<std::uint32_t> points;  ///< of its cells of any dimension, ascending
  std::vector<std::uint32_t> cells;   ///< kept ones, ascending
};

struct ImportedMesh {
  gmap::Mesh mesh;
  std::vector<MeshColumn> point_data;
  std::vector<MeshColumn> cell_data;
  std::vector<MeshGroup> groups;  ///< by ascending name
};

/// Reads a mesh file. `.msh` (Gmsh 1, 2.x, 4.1, text or binary) and `.obj` are read here, every
/// other format is converted by meshio in a process of its own. Points keep their order in the
/// file, unused ones included; cells keep theirs, and those of other dimensions are left out with a
/// warning that counts them. Corner order as in gmap::Mesh; orientation is left to build_map.
/// Empty after an error, which is reported as file-error, mesh-format or mesh-topology and names
/// the line (text) or byte (binary) it is about. Works for any bytes; memory grows with the size of
/// the file, never with a number written in it.
[[nodiscard]] std::optional<ImportedMesh> import_mesh_with_data(const std::filesystem::path& path,
                                                                const MeshImportOptions& options,
                                                                support::Diagnostics& diagnostics);
[[nodiscard]] std::optional<gmap::Mesh> import_mesh(const std::filesystem::path& path,
                                                    const MeshImportOptions& options,
                                                    support::Diagnostics& diagnostics);
[[nodiscard]] std::optional<gmap::Mesh> import_mesh(const std::filesystem::path& path,
                                                    support::Diagnostics& diagnostics);

}  // namespace gmsim::scene
