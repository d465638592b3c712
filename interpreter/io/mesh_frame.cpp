// SPDX-License-Identifier: MIT
#include "io/mesh_frame.h"

#include <algorithm>

#include "support/sort_once.h"

namespace gmsim::io {

namespace {

std::span<const std::int32_t> row(const std::vector<std::int32_t>& table,
                                  const std::vector<std::int32_t>& offsets, std::size_t number) {
  const auto begin = static_cast<std::size_t>(offsets[number]);
  return std::span(table).subspan(begin, static_cast<std::size_t>(offsets[number + 1]) - begin);
}

std::int32_t size_of(const std::vector<std::int32_t>& table) {
  return static_cast<std::int32_t>(table.size());
}

}  // namespace

VtkCell polygon_type(std::size_t corners) {
  switch (corners) {
    case 0:
    case 1:
      return VtkCell::Vertex;
    case 2:
      return VtkCell::Line;
    case 3:
      return VtkCell::Triangle;
    case 4:
      return VtkCell::Quad;
    default:
      return VtkCell::Polygon;
  }
}

std::span<const std::int32_t> MeshTopology::corners(std::size_t cell) const {
  return row(connectivity, offsets, cell);
}

std::span<const std::int32_t> MeshTopology::face(std::size_t number) const {
  return row(face_connectivity, face_offsets, number);
}

std::span<const std::int32_t> MeshTopology::faces(std::size_t cell) const {
  return row(polyhedron_faces, polyhedron_offsets, cell);
}

void MeshTopology::add_cell(VtkCell type, std::span<const std::int32_t> corners) {
  connectivity.insert(connectivity.end(), corners.begin(), corners.end());
  offsets.push_back(size_of(connectivity));
  types.push_back(type);
  polyhedron_offsets.push_back(polyhedron_offsets.back());
}

void MeshTopology::add_polyhedron(const std::vector<std::vector<std::int32_t>>& faces) {
  std::vector<std::int32_t> points;
  for (const auto& face : faces) {
    points.insert(points.end(), face.begin(), face.end());
    polyhedron_faces.push_back(static_cast<std::int32_t>(face_count()));
    face_connectivity.insert(face_connectivity.end(), face.begin(), face.end());
    face_offsets.push_back(size_of(face_connectivity));
  }
  support::sort_once(points);
  add_cell(VtkCell::Polyhedron, points);
  polyhedron_offsets.back() = size_of(polyhedron_faces);
}

}  // namespace gmsim::io
