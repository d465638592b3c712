// SPDX-License-Identifier: MIT
// Small meshes of every kind and random maps, for property tests.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "gmap/gmap.h"
#include "gmap/mesh.h"
#include "gmap/mesh_builders.h"
#include "gmap/random_map.h"

namespace gmsim::tests {

using gmap::Mesh;
using types::DartId;

struct NamedMesh {
  std::string name;
  Mesh mesh;
};

inline Mesh polygon_mesh(std::vector<std::array<double, 3>> points,
                         const std::vector<std::vector<std::uint32_t>>& polygons) {
  Mesh mesh;
  mesh.points = std::move(points);
  for (const auto& polygon : polygons) mesh.add_cell(Mesh::CellKind::Polygon, polygon);
  return mesh;
}

/// The six squares of a cube, a closed surface. Corners as of a hexahedron.
inline Mesh cube_surface() {
  return polygon_mesh(
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
      {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

/// Two triangles on one another: the smallest closed surface of polygons.
inline Mesh pillow() {
  return polygon_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {2, 1, 0}});
}

/// nu x nv quads round a torus; Euler characteristic 0.
inline Mesh torus(std::uint32_t nu, std::uint32_t nv) {
  Mesh mesh;
  for (std::uint32_t j = 0; j < nv; ++j) {
    for (std::uint32_t i = 0; i < nu; ++i) {
      const double u = 2 * std::numbers::pi * i / nu, v = 2 * std::numbers::pi * j / nv;
      mesh.points.push_back(
          {(2 + std::cos(v)) * std::cos(u), (2 + std::cos(v)) * std::sin(u), std::sin(v)});
      const auto point = [&](std::uint32_t k, std::uint32_t l) { return (l % nv) * nu + k % nu; };
      mesh.add_cell(Mesh::CellKind::Polygon,
                    {point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
    }
  }
  return mesh;
}

/// A strip of `count` quads closed with half a turn: one side, one border.
inline Mesh moebius_strip(std::uint32_t count) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double u = 2 * std::numbers::pi * i / count;
    for (double s : {-0.3, 0.3}) {
      const double radius = 1 + s * std::cos(u / 2);
      mesh.points.push_back({radius * std::cos(u), radius * std::sin(u), s * std::sin(u / 2)});
    }
    const bool last = i + 1 == count;
    const std::uint32_t next = last ? 0 : 2 * (i + 1), flip = last ? 1 : 0;
    mesh.add_cell(Mesh::CellKind::Polygon, {2 * i, next + flip, next + 1 - flip, 2 * i + 1});
  }
  return mesh;
}

/// A hexagon among triangles, quads and a pentagon.
inline Mesh mixed_polygons() {
  std::vector<std::array<double, 3>> points;
  for (double radius : {1.0, 2.0}) {
    for (int k = 0; k < 6; ++k) {
      const double u = std::numbers::pi * k / 3;
      points.push_back({radius * std::cos(u), radius * std::sin(u), 0});
    }
  }
  points.push_back({3, 2, 0});
  return polygon_mesh(points, {{0, 1, 2, 3, 4, 5},
                               {0, 6, 12, 7, 1},
                               {1, 7, 8, 2},
                               {2, 8, 9, 3},
                               {3, 9, 10},
                               {3, 10, 4},
                               {4, 10, 11, 5},
                               {5, 11, 6, 0}});
}

/// A hexahedron with a pyramid on top, a prism at its side and a tetrahedron on the pyramid.
inline Mesh mixed_solids() {
  Mesh mesh;
  mesh.dimension = 3;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0},   {0, 1, 0}, {0, 0, 1}, {1, 0, 1},
                 {1, 1, 1}, {0, 1, 1}, {.5, .5, 2}, {2, 0, 0}, {2, 1, 0}, {2, .5, 1.5}};
  mesh.add_cell(Mesh::CellKind::Hexahedron, {0, 1, 2, 3, 4, 5, 6, 7});
  mesh.add_cell(Mesh::CellKind::Pyramid, {4, 5, 6, 7, 8});
  mesh.add_cell(Mesh::CellKind::Prism, {1, 5, 9, 2, 6, 10});
  mesh.add_cell(Mesh::CellKind::Tetrahedron, {5, 6, 8, 11});
  return mesh;
}

/// Two tetrahedra that share an edge only, and a third that shares a point with them.
inline Mesh pinched_tets() {
  Mesh mesh;
  mesh.dimension = 3;
  mesh.points = {{0, 0, 0},   {0, 0, 1},  {1, 0, 0},  {1, 1, 0}, {-1, 0, 0},
                 {-1, -1, 0}, {1, 0, -1}, {0, 1, -1}, {0, 0, -2}};
  mesh.add_cell(Mesh::CellKind::Tetrahedron, {0, 2, 3, 1});
  mesh.add_cell(Mesh::CellKind::Tetrahedron, {0, 4, 5, 1});
  mesh.add_cell(Mesh::CellKind::Tetrahedron, {0, 7, 6, 8});
  return mesh;
}

/// Three segments end to end, closed to a ring.
inline Mesh ring() {
  Mesh mesh;
  mesh.dimension = 1;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (std::uint32_t i = 0; i < 3; ++i) mesh.add_cell(Mesh::CellKind::Segment, {i, (i + 1) % 3});
  return mesh;
}

/// Every group: closed and bordered surfaces, triangles, quads, mixed polygons, a one-sided strip,
/// tetrahedra, hexahedra, mixed solids, chains, pinched meshes.
inline std::vector<NamedMesh> mesh_groups() {
  using gmap::BoxElements;
  using gmap::GridCells;
  return {
      {"chain", gmap::chain(5, 1.0)},
      {"ring", ring()},
      {"quads", gmap::grid(4, 3, 1.0, 1.0, GridCells::Quads)},
      {"triangles", gmap::grid(3, 3, 1.0, 1.0, GridCells::Triangles)},
      {"tri4", gmap::grid(2, 3, 1.0, 1.0, GridCells::Tri4)},
      {"mix2", gmap::grid(3, 3, 1.0, 1.0, GridCells::Mix2)},
      {"mix4", gmap::grid(3, 2, 1.0, 1.0, GridCells::Mix4)},
      {"mixed polygons", mixed_polygons()},
      {"cube surface", cube_surface()},
      {"pillow", pillow()},
      {"torus", torus(4, 3)},
      {"moebius strip", moebius_strip(5)},
      {"pinched triangles", polygon_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}},
                                         {{0, 1, 2}, {0, 3, 4}})},
      {"hexes", gmap::box({3, 2, 2}, {1.0, 1.0, 1.0}, BoxElements::Hexes)},
      {"tets6", gmap::box({2, 1, 2}, {1.0, 1.0, 1.0}, BoxElements::Tets6)},
      {"tets5", gmap::box({2, 2, 1}, {1.0, 1.0, 1.0}, BoxElements::Tets5)},
      {"mixed solids", mixed_solids()},
      {"pinched tets", pinched_tets()}};
}

using gmap::random_map;

/// The same map with dart d renamed to new_id[d], a permutation.
inline gmap::GMap renamed(const gmap::GMap& map, const std::vector<std::uint32_t>& new_id) {
  gmap::GMap result(map.dimension());
  result.add_darts(map.dart_end());
  for (int i = 0; i <= map.dimension(); ++i) {
    for (std::uint32_t d = 0; d < map.dart_end(); ++d) {
      const DartId other = map.alpha(i, DartId{d});
      result.set_alpha(i, DartId{new_id[d]}, DartId{new_id[types::index(other)]});
    }
  }
  return result;
}

}  // namespace gmsim::tests
