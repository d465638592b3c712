// SPDX-License-Identifier: MIT
#include "stdlib/block_mesh.h"

#include <stdexcept>

#include "scene/mesh_spec.h"

namespace gmsim::test {
namespace {

using CellKind = gmap::Mesh::CellKind;

CellKind kind_of(int dimension, std::size_t corners) {
  if (dimension == 1) return CellKind::Segment;
  if (dimension == 2) return CellKind::Polygon;
  switch (corners) {
    case 4: return CellKind::Tetrahedron;
    case 5: return CellKind::Pyramid;
    case 6: return CellKind::Prism;
    case 8: return CellKind::Hexahedron;
    default: throw std::runtime_error("a solid has 4, 5, 6 or 8 corners");
  }
}

gmap::Mesh inline_mesh(const YAML::Node& node) {
  const auto cells = node["cells"].as<std::vector<std::vector<std::uint32_t>>>();
  gmap::Mesh mesh;
  const int by_arity = cells.front().size() == 2 ? 1 : 2;
  mesh.dimension = node["dimension"] ? node["dimension"].as<int>() : by_arity;
  mesh.points = node["points"].as<std::vector<std::array<double, 3>>>();
  for (const auto& corners : cells)
    mesh.add_cell(kind_of(mesh.dimension, corners.size()), corners);
  return mesh;
}

}  // namespace

gmap::Mesh mesh_of(const YAML::Node& node, support::Diagnostics& diagnostics) {
  if (node.IsMap()) return inline_mesh(node);
  const auto mesh = scene::mesh_from_spec(node.as<std::string>(), diagnostics);
  if (!mesh) throw std::runtime_error("no mesh from `" + node.as<std::string>() + "`");
  return *mesh;
}

}  // namespace gmsim::test
