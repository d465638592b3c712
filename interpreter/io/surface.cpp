// SPDX-License-Identifier: MIT
#include "io/surface.h"

#include <algorithm>
#include <numeric>

#include "gmap/solid_shape.h"

namespace gmsim::io {

namespace {

using Kind = gmap::Mesh::CellKind;

/// Every face of every solid, and of each its corners in ascending order to compare it by.
struct Faces {
  Surface all;
  std::vector<std::int32_t> keys;  ///< corners sorted within each face; sliced as all.begin

  void add(std::span<const std::int32_t> face, std::int32_t cell) {
    all.corners.insert(all.corners.end(), face.begin(), face.end());
    all.begin.push_back(static_cast<std::int32_t>(all.corners.size()));
    all.cells.push_back(cell);
    keys.insert(keys.end(), face.begin(), face.end());
    std::sort(keys.end() - static_cast<std::ptrdiff_t>(face.size()), keys.end());
  }
  [[nodiscard]] std::span<const std::int32_t> key(std::size_t number) const {
    const auto begin = static_cast<std::size_t>(all.begin[number]);
    return std::span(keys).subspan(begin, static_cast<std::size_t>(all.begin[number + 1]) - begin);
  }
};

void add_solid(Kind kind, const MeshTopology& topology, std::size_t cell, Faces& faces) {
  const auto corners = topology.corners(cell);
  std::vector<std::int32_t> face;
  for (const auto& facet : gmap::solid_facets(kind)) {
    face.clear();
    for (std::uint8_t corner : facet) face.push_back(corners[corner]);
    std::reverse(face.begin(), face.end());  // solid_facets look inwards
    faces.add(face, static_cast<std::int32_t>(cell));
  }
}

void add_polygon(std::span<const std::int32_t> corners, std::size_t cell, Surface& surface) {
  surface.corners.insert(surface.corners.end(), corners.begin(), corners.end());
  surface.begin.push_back(static_cast<std::int32_t>(surface.corners.size()));
  surface.cells.push_back(static_cast<std::int32_t>(cell));
}

/// Adds the faces that occur once, in their order.
void add_unshared(const Faces& faces, Surface& surface) {
  std::vector<std::size_t> order(faces.all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::ranges::lexicographical_compare(faces.key(a), faces.key(b));
  });
  std::vector<std::size_t> unshared;
  for (std::size_t i = 0; i < order.size();) {
    std::size_t end = i + 1;
    while (end < order.size() && std::ranges::equal(faces.key(order[i]), faces.key(order[end])))
      ++end;
    if (end == i + 1) unshared.push_back(order[i]);
    i = end;
  }
  std::sort(unshared.begin(), unshared.end());
  for (std::size_t face : unshared) {
    add_polygon(faces.all.polygon(face), static_cast<std::size_t>(faces.all.cells[face]), surface);
  }
}

}  // namespace

std::span<const std::int32_t> Surface::polygon(std::size_t number) const {
  const auto first = static_cast<std::size_t>(begin[number]);
  return std::span(corners).subspan(first, static_cast<std::size_t>(begin[number + 1]) - first);
}

Surface visible_surface(const MeshTopology& topology) {
  Surface surface;
  Faces faces;
  for (std::size_t cell = 0; cell < topology.cell_count(); ++cell) {
    switch (topology.types[cell]) {
      case VtkCell::Vertex:
      case VtkCell::Line:
        break;
      case VtkCell::Triangle:
      case VtkCell::Quad:
      case VtkCell::Polygon:
        add_polygon(topology.corners(cell), cell, surface);
        break;
      case VtkCell::Tetrahedron:
        add_solid(Kind::Tetrahedron, topology, cell, faces);
        break;
      case VtkCell::Hexahedron:
        add_solid(Kind::Hexahedron, topology, cell, faces);
        break;
      case VtkCell::Wedge:
        add_solid(Kind::Prism, topology, cell, faces);
        break;
      case VtkCell::Pyramid:
        add_solid(Kind::Pyramid, topology, cell, faces);
        break;
      case VtkCell::Polyhedron:
        for (std::int32_t face : topology.faces(cell)) {
          faces.add(topology.face(static_cast<std::size_t>(face)), static_cast<std::int32_t>(cell));
        }
        break;
    }
  }
  add_unshared(faces, surface);
  return surface;
}

}  // namespace gmsim::io
