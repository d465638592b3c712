// SPDX-License-Identifier: MIT
#include "gmap/cell_measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "gmap/solid_shape.h"

namespace gmsim::gmap {
namespace {

using Point = std::array<double, 3>;
using Corners = std::span<const std::uint32_t>;

Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Point operator+(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Point operator*(double s, const Point& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Half the sum of the cross products of successive corners (Newell): for a plane polygon its area.
double polygon_area(const Mesh& mesh, Corners corners) {
  Point sum{};
  for (std::size_t c = 1; c + 1 < corners.size(); ++c) {
    sum = sum + cross(mesh.points[corners[c]] - mesh.points[corners[0]],
                      mesh.points[corners[c + 1]] - mesh.points[corners[0]]);
  }
  return 0.5 * std::sqrt(dot(sum, sum));
}

/// Signed volume by the divergence theorem; facets are cones over their mean point.
double solid_volume(const Mesh& mesh, Mesh::CellKind kind, Corners corners) {
  const auto relative = [&](std::uint8_t c) {
    return mesh.points[corners[c]] - mesh.points[corners[0]];
  };
  double six_volumes = 0.0;
  for (const auto& facet : solid_facets(kind)) {
    Point mean{};
    for (std::uint8_t c : facet) mean = mean + relative(c);
    mean = (1.0 / static_cast<double>(facet.size())) * mean;
    for (std::size_t c = 0; c < facet.size(); ++c) {
      six_volumes -= dot(mean, cross(relative(facet[c]), relative(facet[(c + 1) % facet.size()])));
    }
  }
  return six_volumes / 6.0;
}

}  // namespace

double cell_extent(const Mesh& mesh, std::size_t cell) {
  const Corners corners = mesh.corners(cell);
  double largest = 0.0;  // squared
  for (std::uint32_t p : corners) {
    const Point edge = mesh.points[p] - mesh.points[corners[0]];
    largest = std::max(largest, dot(edge, edge));
  }
  return std::sqrt(largest);
}

double signed_cell_measure(const Mesh& mesh, std::size_t cell) {
  switch (mesh.dimension) {
    case 1:
      return cell_extent(mesh, cell);
    case 2:
      return polygon_area(mesh, mesh.corners(cell));
    default:
      return solid_volume(mesh, mesh.kinds[cell], mesh.corners(cell));
  }
}

double cell_measure(const Mesh& mesh, std::size_t cell) {
  return std::abs(signed_cell_measure(mesh, cell));
}

}  // namespace gmsim::gmap
