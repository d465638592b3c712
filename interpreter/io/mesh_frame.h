// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gmsim::io {

/// Cell types with the codes of VTK.
enum class VtkCell : std::uint8_t {
  Vertex = 1,
  Line = 3,
  Triangle = 5,
  Polygon = 7,
  Quad = 9,
  Tetrahedron = 10,
  Hexahedron = 12,
  Wedge = 13,
  Pyramid = 14,
  Polyhedron = 42
};

/// Triangle, Quad or Polygon; fewer than three corners give a Line or a Vertex.
[[nodiscard]] VtkCell polygon_type(std::size_t corners);

/// How numbers are stored in a file.
enum class NumberType { Float64, Float32, Int64, Int32 };

/// Cells of point numbers in VTK's tables: cell c has the corners
/// connectivity[offsets[c] .. offsets[c + 1]). The faces of polyhedra stand in three further
/// tables; connectivity then lists the distinct points.
struct MeshTopology {
  std::vector<std::int32_t> connectivity;
  std::vector<std::int32_t> offsets = {0};
  std::vector<VtkCell> types;
  std::vector<std::int32_t> face_connectivity;         ///< corners of faces, seen from outside
  std::vector<std::int32_t> face_offsets = {0};        ///< one more than faces
  std::vector<std::int32_t> polyhedron_faces;          ///< face numbers
  std::vector<std::int32_t> polyhedron_offsets = {0};  ///< one more than cells; repeats over others

  [[nodiscard]] std::size_t cell_count() const { return types.size(); }
  [[nodiscard]] std::size_t face_count() const { return face_offsets.size() - 1; }
  [[nodiscard]] bool has_polyhedra() const { return !polyhedron_faces.empty(); }
  [[nodiscard]] std::span<const std::int32_t> corners(std::size_t cell) const;
  [[nodiscard]] std::span<const std::int32_t> face(std::size_t number) const;
  /// The faces of a cell by their numbers; none unless it is a polyhedron.
  [[nodiscard]] std::span<const std::int32_t> faces(std::size_t cell) const;

  void add_cell(VtkCell type, std::span<const std::int32_t> corners);
  void add_polyhedron(const std::vector<std::vector<std::int32_t>>& faces);
  bool operator==(const MeshTopology&) const = default;
};

/// One named array, `components` numbers a row.
struct DataArray {
  std::string name;
  std::uint32_t components = 1;
  NumberType type = NumberType::Float64;
  std::vector<double> values;
};

/// A mesh at one moment with its fields.
struct MeshFrame {
  std::vector<std::array<double, 3>> points;
  MeshTopology topology;
  std::vector<DataArray> point_data;
  std::vector<DataArray> cell_data;
  std::optional<double> time;  ///< s
};

}  // namespace gmsim::io
