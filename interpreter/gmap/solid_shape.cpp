// SPDX-License-Identifier: MIT
#include "gmap/solid_shape.h"

#include <array>
#include <map>
#include <utility>

namespace gmsim::gmap {

namespace {

using Facets = std::vector<std::vector<std::uint8_t>>;

struct Shape {
  Facets facets;
  std::vector<std::uint8_t> mirrored;
};

const Shape& shape(Mesh::CellKind kind) {
  static const Shape tetrahedron{{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}}, {0, 2, 1, 3}};
  static const Shape hexahedron{
      {{0, 1, 2, 3}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}, {4, 7, 6, 5}},
      {0, 3, 2, 1, 4, 7, 6, 5}};
  static const Shape prism{{{0, 1, 2}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}, {3, 5, 4}},
                           {0, 2, 1, 3, 5, 4}};
  static const Shape pyramid{{{0, 1, 2, 3}, {0, 4, 1}, {1, 4, 2}, {2, 4, 3}, {3, 4, 0}},
                             {0, 3, 2, 1, 4}};
  switch (kind) {
    case Mesh::CellKind::Tetrahedron:
      return tetrahedron;
    case Mesh::CellKind::Hexahedron:
      return hexahedron;
    case Mesh::CellKind::Prism:
      return prism;
    case Mesh::CellKind::Pyramid:
      return pyramid;
    case Mesh::CellKind::Segment:
    case Mesh::CellKind::Polygon:
      break;
  }
  support::internal_error(__FILE__, __LINE__, "not a solid");
}

}  // namespace

std::span<const std::vector<std::uint8_t>> solid_facets(Mesh::CellKind kind) {
  return shape(kind).facets;
}

std::span<const std::uint8_t> mirrored_corners(Mesh::CellKind kind) {
  return shape(kind).mirrored;
}

SolidDarts solid_darts(Mesh::CellKind kind) {
  SolidDarts darts;
  // Edge from corner to corner as one facet runs along it -> first dart of that edge there.
  std::map<std::pair<std::uint8_t, std::uint8_t>, std::uint8_t> edges;
  for (const auto& facet : solid_facets(kind)) {
    const auto first = static_cast<std::uint8_t>(darts.corner.size());
    const auto last = static_cast<std::uint8_t>(first + 2 * facet.size() - 1);
    for (std::size_t c = 0; c < facet.size(); ++c) {
      const std::uint8_t from = facet[c], to = facet[(c + 1) % facet.size()];
      const auto d = static_cast<std::uint8_t>(first + 2 * c);
      const auto other = static_cast<std::uint8_t>(d + 1);
      edges[{from, to}] = d;
      darts.corner.insert(darts.corner.end(), {from, to});
      darts.alpha[0].insert(darts.alpha[0].end(), {other, d});
      darts.alpha[1].push_back(d == first ? last : static_cast<std::uint8_t>(d - 1));
      darts.alpha[1].push_back(other == last ? first : static_cast<std::uint8_t>(other + 1));
    }
  }
  darts.alpha[2].resize(darts.corner.size());
  for (const auto& [edge, d] : edges) {  // the facet beyond runs along it the other way
    const std::uint8_t beyond = edges.at({edge.second, edge.first});
    darts.alpha[2][d] = static_cast<std::uint8_t>(beyond + 1);
    darts.alpha[2][d + 1u] = beyond;
  }
  return darts;
}

}  // namespace gmsim::gmap
