// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "gmap/mesh.h"
#include "gmap/mesh_problems.h"
#include "gmap/orbit_index.h"
#include "gmap/sew_facets.h"
#include "gmap/solid_shape.h"

namespace gmsim::gmap {

namespace {

constexpr std::size_t kKinds = 6;

/// Makes the darts of the cells, one cell after another, with all links inside a cell.
class CellMaker {
 public:
  CellMaker(const Mesh& mesh, MeshMap& built) : mesh_(mesh), built_(built) {}

  std::vector<CellFacet> make(std::span<const std::uint32_t> cell_points,
                              std::span<const std::uint32_t> order) {
    built_.map.add_darts(count_darts());
    built_.dart_point.resize(built_.map.dart_end());
    built_.dart_cell.resize(built_.map.dart_end());
    for (std::size_t k = 0; k < mesh_.cell_count(); ++k) {
      const std::size_t cell = order.empty() ? k : order[k];
      const auto corners = cell_points.subspan(mesh_.cell_begin[cell], mesh_.corners(cell).size());
      const std::uint32_t first = next_;
      switch (mesh_.kinds[cell]) {
        case Mesh::CellKind::Segment:
          add_segment(corners);
          break;
        case Mesh::CellKind::Polygon:
          add_polygon(corners);
          break;
        case Mesh::CellKind::Tetrahedron:
        case Mesh::CellKind::Hexahedron:
        case Mesh::CellKind::Prism:
        case Mesh::CellKind::Pyramid:
          add_solid(mesh_.kinds[cell], corners);
          break;
      }
      std::fill(built_.dart_cell.begin() + first, built_.dart_cell.begin() + next_,
                static_cast<std::uint32_t>(cell));
    }
    return std::move(facets_);
  }

 private:
  const SolidDarts& shape(Mesh::CellKind kind) {
    auto& shape = shapes_[static_cast<std::size_t>(kind)];
    if (!shape) shape = solid_darts(kind);
    return *shape;
  }

  std::uint32_t count_darts() {
    std::size_t count = 0, facets = 0;
    for (std::size_t cell = 0; cell < mesh_.cell_count(); ++cell) {
      const std::size_t corners = mesh_.corners(cell).size();
      switch (mesh_.kinds[cell]) {
        case Mesh::CellKind::Segment:
          count += 2, facets += 2;
          break;
        case Mesh::CellKind::Polygon:
          count += 2 * corners, facets += corners;
          break;
        case Mesh::CellKind::Tetrahedron:
        case Mesh::CellKind::Hexahedron:
        case Mesh::CellKind::Prism:
        case Mesh::CellKind::Pyramid:
          count += shape(mesh_.kinds[cell]).corner.size();
          facets += solid_facets(mesh_.kinds[cell]).size();
      }
    }
    GMSIM_CHECK(count < 0x80000000u, "more than 2^31 darts");
    facets_.reserve(facets);
    return static_cast<std::uint32_t>(count);
  }

  void add_segment(std::span<const std::uint32_t> corners) {
    built_.map.link(0, DartId{next_}, DartId{next_ + 1});
    for (std::uint32_t c = 0; c < 2; ++c) {
      built_.dart_point[next_] = corners[c];
      facets_.push_back({DartId{next_++}, 1});
    }
  }

  void add_polygon(std::span<const std::uint32_t> corners) {
    const auto count = static_cast<std::uint32_t>(corners.size());
    const std::uint32_t first = next_, last = first + 2 * count - 1;
    for (std::uint32_t c = 0; c < count; ++c, next_ += 2) {
      const DartId d{next_}, other{next_ + 1};
      built_.map.set_alpha(0, d, other);
      built_.map.set_alpha(0, other, d);
      built_.map.set_alpha(1, d, DartId{c == 0 ? last : next_ - 1});
      built_.map.set_alpha(1, other, DartId{c + 1 == count ? first : next_ + 2});
      built_.dart_point[next_] = corners[c];
      built_.dart_point[next_ + 1] = corners[c + 1 == count ? 0 : c + 1];
      facets_.push_back({d, 2});
    }
  }

  void add_solid(Mesh::CellKind kind, std::span<const std::uint32_t> corners) {
    const SolidDarts& darts = shape(kind);
    for (std::uint32_t d = 0; d < darts.corner.size(); ++d) {
      built_.dart_point[next_ + d] = corners[darts.corner[d]];
      for (int i = 0; i < 3; ++i) {
        built_.map.set_alpha(i, DartId{next_ + d}, DartId{next_ + darts.alpha[i][d]});
      }
    }
    for (const auto& facet : solid_facets(kind)) {
      const auto count = static_cast<std::uint32_t>(2 * facet.size());
      facets_.push_back({DartId{next_}, count});
      next_ += count;
    }
  }

  const Mesh& mesh_;
  MeshMap& built_;
  std::uint32_t next_ = 0;  // first dart of the next cell
  std::vector<CellFacet> facets_;
  std::array<std::optional<SolidDarts>, kKinds> shapes_;
};

/// Finds the vertices of the points; a point with more than one is pinched.
void find_vertices(MeshMap& built) {
  const OrbitIndex vertices(built.map, OrbitType::cell(0, built.map.dimension()));
  std::vector<std::uint32_t> count(built.point_dart.size(), 0);
  for (Row row = 0; row < vertices.row_end(); ++row) {
    const DartId d = vertices.smallest(row);
    const std::uint32_t p = built.dart_point[index(d)];
    if (++count[p] == 1) built.point_dart[p] = d;
  }
  ProblemList pinched(false, "pinched points, where the cells fall apart into several vertices");
  for (std::size_t p = 0; p < count.size(); ++p) {
    if (count[p] > 1) pinched.add(fmt::format("{} ({} vertices)", p, count[p]));
  }
  pinched.report(built.problems);
}

/// Reports pairs of points that several edges of a solid mesh connect.
void find_pinched_edges(MeshMap& built) {
  const OrbitIndex edges(built.map, OrbitType::cell(1, 3));
  std::vector<std::array<std::uint32_t, 2>> ends;
  for (Row row = 0; row < edges.row_end(); ++row) {
    const DartId d = edges.smallest(row);
    const std::uint32_t a = built.dart_point[index(d)];
    const std::uint32_t b = built.dart_point[index(built.map.alpha(0, d))];
    ends.push_back({std::min(a, b), std::max(a, b)});
  }
  std::sort(ends.begin(), ends.end());
  ProblemList pinched(false,
                      "pinched edges, around which the solids fall apart into several edges");
  for (std::size_t begin = 0, end = 0; begin < ends.size(); begin = end) {
    while (end < ends.size() && ends[end] == ends[begin]) ++end;
    if (end - begin == 1) continue;
    pinched.add(fmt::format("{}-{} ({} edges)", ends[begin][0], ends[begin][1], end - begin));
  }
  pinched.report(built.problems);
}

MeshMap nothing(std::vector<MeshProblem> problems) {
  MeshMap empty;
  empty.problems = std::move(problems);
  return empty;
}

}  // namespace

MeshMap build_map(const Mesh& mesh, std::span<const std::uint32_t> order) {
  GMSIM_CHECK(mesh.dimension >= 1 && mesh.dimension <= 3, "a mesh has dimension 1, 2 or 3");
  GMSIM_CHECK(order.empty() || order.size() == mesh.cell_count(), "an order names every cell");
  MeshMap built;
  built.map = GMap(mesh.dimension);
  const std::vector<std::uint32_t> cell_points = check_cells(mesh, built.problems);
  if (built.failed()) return nothing(std::move(built.problems));
  built.point_dart.assign(mesh.points.size(), kNoDart);
  const std::vector<CellFacet> facets = CellMaker(mesh, built).make(cell_points, order);
  sew_facets(built, facets);
  if (built.failed()) return nothing(std::move(built.problems));
  find_vertices(built);
  if (mesh.dimension == 3) find_pinched_edges(built);
  return built;
}

}  // namespace gmsim::gmap
