// SPDX-License-Identifier: MIT
#include "io/mesh_frame_from_map.h"

#include <algorithm>

#include "gmap/orbit_walk.h"
#include "gmap/solid_shape.h"
#include "io/solid_cells.h"

namespace gmsim::io {

namespace {

using gmap::DartId;
using gmap::GMap;
using Kind = gmap::Mesh::CellKind;
using Point = std::array<double, 3>;
using Corners = std::vector<std::int32_t>;

VtkCell vtk_type(Kind kind) {
  switch (kind) {
    case Kind::Segment:
      return VtkCell::Line;
    case Kind::Polygon:
      return VtkCell::Polygon;
    case Kind::Tetrahedron:
      return VtkCell::Tetrahedron;
    case Kind::Hexahedron:
      return VtkCell::Hexahedron;
    case Kind::Prism:
      return VtkCell::Wedge;
    case Kind::Pyramid:
      return VtkCell::Pyramid;
  }
  return VtkCell::Vertex;
}

class FrameBuilder {
 public:
  FrameBuilder(const GMap& map, const gmap::OrbitIndex& vertices, const PointNumbering& numbering,
               const DartPosition& position, PolyhedronStyle style)
      : map_(map), vertices_(vertices), numbering_(numbering), style_(style) {
    for (gmap::Row row : numbering.rows()) {
      frame_.point_darts.push_back(vertices.smallest(row));
      frame_.mesh.points.push_back(position(vertices.smallest(row)));
    }
  }

  MapFrame build() {
    const auto cell = gmap::OrbitType::range(0, map_.dimension() - 1);
    std::vector<bool> done(map_.dart_end(), false);
    for (std::uint32_t i = 0; i < map_.dart_end(); ++i) {
      const DartId dart{i};
      if (done[i] || !map_.alive(dart)) continue;
      std::vector<DartId> darts;
      gmap::for_each_dart(map_, cell, dart, [&](DartId d) {
        done[gmap::index(d)] = true;
        darts.push_back(d);
      });
      std::sort(darts.begin(), darts.end());
      add_cell(darts);
    }
    return std::move(frame_);
  }

 private:
  void add_cell(const std::vector<DartId>& darts) {
    switch (map_.dimension()) {
      case 1:
        add_edge(darts);
        break;
      case 2:
        add_face(face_corners(map_, darts.front()), darts.front());
        break;
      case 3:
        add_volume(darts);
        break;
    }
  }

  void add_edge(const std::vector<DartId>& darts) {
    add(darts.size() == 1 ? VtkCell::Vertex : VtkCell::Line, numbers(darts), darts.front());
  }

  void add_face(const Face& face, DartId dart) {
    add(polygon_type(face.size()), numbers(face), dart);
  }

  void add_volume(const std::vector<DartId>& darts) {
    if (const auto solid = recognizer_.match(map_, darts)) {
      add(vtk_type(solid->kind), turned(solid->kind, numbers(solid->corners)), darts.front());
    } else if (style_ == PolyhedronStyle::Faces) {
      for (const Face& face : volume_faces(map_, darts)) {
        add_face(face, gmap::smallest_dart(map_, gmap::OrbitType{0, 1}, face.front()));
      }
    } else {
      add_polyhedron(darts);
    }
  }

  void add_polyhedron(const std::vector<DartId>& darts) {
    std::vector<Corners> faces;
    for (const Face& face : volume_faces(map_, darts)) faces.push_back(numbers(face));
    if (volume(faces) < 0) {
      for (Corners& face : faces) std::reverse(face.begin(), face.end());
    }
    frame_.mesh.topology.add_polyhedron(faces);
    frame_.cell_darts.push_back(darts.front());
  }

  /// The corners, mirrored if the solid would have a negative volume.
  [[nodiscard]] Corners turned(Kind kind, const Corners& corners) const {
    std::vector<Corners> facets;
    for (const auto& facet : gmap::solid_facets(kind)) {
      Corners& face = facets.emplace_back();
      for (std::uint8_t corner : facet) face.push_back(corners[corner]);
      std::reverse(face.begin(), face.end());  // solid_facets look inwards
    }
    if (volume(facets) >= 0) return corners;
    Corners mirrored;
    for (std::uint8_t corner : gmap::mirrored_corners(kind)) mirrored.push_back(corners[corner]);
    return mirrored;
  }

  /// Of a closed surface whose faces are seen from outside; faces are cut into triangles around
  /// their first corner. Relative to the first point, so that far away bodies lose no digits.
  [[nodiscard]] double volume(const std::vector<Corners>& faces) const {
    if (faces.empty() || faces.front().empty()) return 0;
    const Point& origin = frame_.mesh.points[static_cast<std::size_t>(faces.front().front())];
    const auto relative = [&](std::int32_t number) {
      const Point& point = frame_.mesh.points[static_cast<std::size_t>(number)];
      return Point{point[0] - origin[0], point[1] - origin[1], point[2] - origin[2]};
    };
    double six_volumes = 0;
    for (const Corners& face : faces) {
      for (std::size_t i = 1; i + 1 < face.size(); ++i) {
        const Point a = relative(face[0]), b = relative(face[i]), c = relative(face[i + 1]);
        six_volumes += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                       a[2] * (b[0] * c[1] - b[1] * c[0]);
      }
    }
    return six_volumes / 6;
  }

  [[nodiscard]] Corners numbers(const std::vector<DartId>& darts) const {
    Corners result;
    for (DartId dart : darts) result.push_back(numbering_.number(vertices_.row(dart)));
    return result;
  }

  void add(VtkCell type, const Corners& corners, DartId dart) {
    frame_.mesh.topology.add_cell(type, corners);
    frame_.cell_darts.push_back(dart);
  }

  const GMap& map_;
  const gmap::OrbitIndex& vertices_;
  const PointNumbering& numbering_;
  PolyhedronStyle style_;
  SolidRecognizer recognizer_;
  MapFrame frame_;
};

}  // namespace

MapFrame mesh_frame_from_map(const GMap& map, const gmap::OrbitIndex& vertices,
                             const PointNumbering& numbering, const DartPosition& position,
                             PolyhedronStyle style) {
  return FrameBuilder(map, vertices, numbering, position, style).build();
}

}  // namespace gmsim::io
