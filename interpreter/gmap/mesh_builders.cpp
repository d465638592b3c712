// SPDX-License-Identifier: MIT
#include "gmap/mesh_builders.h"

#include <limits>

namespace gmsim::gmap {

namespace {

using Corners = std::vector<std::uint32_t>;

bool split_in_four(GridCells cells, bool odd) {
  return cells == GridCells::Tri4 || (cells == GridCells::Mix4 && odd);
}

bool split_in_two(GridCells cells, bool odd) {
  return cells == GridCells::Triangles || (cells == GridCells::Mix2 && odd);
}

/// Adds the cells of one patch with corners a, b, c, d counterclockwise from the lower left.
void add_patch(Mesh& mesh, GridCells cells, bool odd, const std::array<std::uint32_t, 4>& corners) {
  const auto [a, b, c, d] = corners;
  const auto polygon = [&](const Corners& points) {
    mesh.add_cell(Mesh::CellKind::Polygon, points);
  };
  if (split_in_two(cells, odd)) {
    polygon({a, b, c});
    polygon({a, c, d});
  } else if (split_in_four(cells, odd)) {
    const auto& lower = mesh.points[a];
    const auto& upper = mesh.points[c];
    const auto middle = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back({0.5 * (lower[0] + upper[0]), 0.5 * (lower[1] + upper[1]), 0.0});
    for (std::size_t k = 0; k < 4; ++k) polygon({corners[k], corners[(k + 1) % 4], middle});
  } else {
    polygon({a, b, c, d});
  }
}

/// Tetrahedra of a cell whose corners are numbered bit by bit: corner x + 2y + 4z.
constexpr std::array<std::array<int, 4>, 6> kSixTets = {
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};
/// One in the middle and one cut off at each of the corners 0, 3, 5, 6.
constexpr std::array<std::array<int, 4>, 5> kFiveTets = {
    {{1, 2, 4, 7}, {0, 1, 2, 4}, {3, 2, 1, 7}, {5, 1, 4, 7}, {6, 4, 2, 7}}};

void add_hexahedron(Mesh& mesh, const std::array<std::uint32_t, 8>& c) {
  mesh.add_cell(Mesh::CellKind::Hexahedron, {c[0], c[1], c[3], c[2], c[4], c[5], c[7], c[6]});
}

void add_six_tets(Mesh& mesh, const std::array<std::uint32_t, 8>& c) {
  for (const auto& t : kSixTets) {
    mesh.add_cell(Mesh::CellKind::Tetrahedron, {c[t[0]], c[t[1]], c[t[2]], c[t[3]]});
  }
}

/// Every other cell is mirrored in x, so that the diagonals of neighbours agree.
void add_five_tets(Mesh& mesh, const std::array<std::uint32_t, 8>& c, bool mirrored) {
  const int flip = mirrored ? 1 : 0;
  for (const auto& t : kFiveTets) {
    Corners corners{c[t[0] ^ flip], c[t[1] ^ flip], c[t[2] ^ flip], c[t[3] ^ flip]};
    if (mirrored) std::swap(corners[2], corners[3]);  // keep the volume positive
    mesh.add_cell(Mesh::CellKind::Tetrahedron, corners);
  }
}

std::uint32_t checked_product(std::initializer_list<std::uint64_t> factors) {
  std::uint64_t product = 1;
  for (std::uint64_t factor : factors) {
    GMSIM_CHECK(factor > 0, "a builder needs at least one cell each way");
    GMSIM_CHECK(factor <= std::numeric_limits<std::uint32_t>::max() / product, "mesh too large");
    product *= factor;
  }
  return static_cast<std::uint32_t>(product);
}

}  // namespace

Mesh grid(std::uint32_t nx, std::uint32_t ny, double width, double height, GridCells cells) {
  checked_product({nx, ny});
  Mesh mesh;
  mesh.points.reserve(checked_product({nx + std::uint64_t{1}, ny + std::uint64_t{1}}));
  for (std::uint32_t j = 0; j <= ny; ++j) {
    for (std::uint32_t i = 0; i <= nx; ++i) {
      mesh.points.push_back({width * i / nx, height * j / ny, 0.0});
    }
  }
  for (std::uint32_t j = 0; j < ny; ++j) {
    for (std::uint32_t i = 0; i < nx; ++i) {
      const std::uint32_t a = j * (nx + 1) + i, d = a + nx + 1;
      add_patch(mesh, cells, (i + j) % 2 == 1, {a, a + 1, d + 1, d});
    }
  }
  return mesh;
}

Mesh box(std::array<std::uint32_t, 3> cells, std::array<double, 3> size, BoxElements elements) {
  const auto [nx, ny, nz] = cells;
  checked_product({nx, ny, nz});
  Mesh mesh;
  mesh.dimension = 3;
  mesh.points.reserve(
      checked_product({nx + std::uint64_t{1}, ny + std::uint64_t{1}, nz + std::uint64_t{1}}));
  for (std::uint32_t k = 0; k <= nz; ++k) {
    for (std::uint32_t j = 0; j <= ny; ++j) {
      for (std::uint32_t i = 0; i <= nx; ++i) {
        mesh.points.push_back({size[0] * i / nx, size[1] * j / ny, size[2] * k / nz});
      }
    }
  }
  const std::uint32_t row = nx + 1, layer = row * (ny + 1);
  for (std::uint32_t k = 0; k < nz; ++k) {
    for (std::uint32_t j = 0; j < ny; ++j) {
      for (std::uint32_t i = 0; i < nx; ++i) {
        const std::uint32_t a = k * layer + j * row + i;
        const std::array<std::uint32_t, 8> corners{
            a,         a + 1,         a + row,         a + row + 1,
            a + layer, a + layer + 1, a + layer + row, a + layer + row + 1};
        switch (elements) {
          case BoxElements::Hexes:
            add_hexahedron(mesh, corners);
            break;
          case BoxElements::Tets6:
            add_six_tets(mesh, corners);
            break;
          case BoxElements::Tets5:
            add_five_tets(mesh, corners, (i + j + k) % 2 == 1);
            break;
        }
      }
    }
  }
  return mesh;
}

Mesh chain(std::uint32_t segments, double length) {
  checked_product({segments});
  Mesh mesh;
  mesh.dimension = 1;
  for (std::uint32_t i = 0; i <= segments; ++i) {
    mesh.points.push_back({length * i / segments, 0.0, 0.0});
    if (i > 0) mesh.add_cell(Mesh::CellKind::Segment, {i - 1, i});
  }
  return mesh;
}

}  // namespace gmsim::gmap
