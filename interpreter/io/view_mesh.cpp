// SPDX-License-Identifier: MIT
#include "io/view_mesh.h"

#include <algorithm>
#include <map>
#include <utility>

#include "io/surface.h"
#include "io/triangulate.h"

namespace gmsim::io {

namespace {

/// Numbers things anew in the order in which they are first asked for.
class Renumbering {
 public:
  Renumbering(std::size_t count, std::vector<std::uint32_t>& kept) : new_(count, -1), kept_(kept) {}
  std::uint32_t operator()(std::int32_t number) {
    std::int64_t& found = new_[static_cast<std::size_t>(number)];
    if (found < 0) {
      found = std::ssize(kept_);
      kept_.push_back(static_cast<std::uint32_t>(number));
    }
    return static_cast<std::uint32_t>(found);
  }

 private:
  std::vector<std::int64_t> new_;
  std::vector<std::uint32_t>& kept_;
};

struct Builder {
  ViewMesh mesh;
  Renumbering point, cell;

  Builder(std::size_t points, std::size_t cells)
      : point(points, mesh.points), cell(cells, mesh.cells) {
    mesh.all_points = points;
    mesh.all_cells = cells;
  }
  Builder(const Builder&) = delete;
  Builder& operator=(const Builder&) = delete;

  void add_triangles(const Surface& surface, std::span<const std::array<double, 3>> points) {
    std::vector<std::int32_t> triangles;
    for (std::size_t i = 0; i < surface.size(); ++i) {
      triangles.clear();
      triangulate(surface.polygon(i), points, triangles);
      for (const std::int32_t corner : triangles) mesh.triangles.push_back(point(corner));
      mesh.triangle_cells.insert(mesh.triangle_cells.end(), triangles.size() / 3,
                                 cell(surface.cells[i]));
    }
  }

  void add_edges(const Surface& surface) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> polygons_of;
    for (std::size_t i = 0; i < surface.size(); ++i) {
      const auto polygon = surface.polygon(i);
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const auto [low, high] =
            std::minmax({point(polygon[k]), point(polygon[(k + 1) % polygon.size()])});
        ++polygons_of[{low, high}];
      }
    }
    const auto append = [&](bool outline) {
      for (const auto& [ends, polygons] : polygons_of)
        if ((polygons == 1) == outline) mesh.edges.insert(mesh.edges.end(), {ends.first, ends.second});
    };
    append(true);
    mesh.outline_edges = mesh.edges.size() / 2;
    append(false);
  }

  void add_lines_and_dots(const MeshTopology& topology) {
    for (std::size_t i = 0; i < topology.cell_count(); ++i) {
      const bool is_line = topology.types[i] == VtkCell::Line;
      if (!is_line && topology.types[i] != VtkCell::Vertex) continue;
      for (const std::int32_t corner : topology.corners(i))
        (is_line ? mesh.lines : mesh.dots).push_back(point(corner));
      (is_line ? mesh.line_cells : mesh.dot_cells).push_back(cell(static_cast<std::int32_t>(i)));
    }
  }
};

}  // namespace

ViewMesh view_mesh(const MeshTopology& topology, std::span<const std::array<double, 3>> points) {
  Builder builder(points.size(), topology.cell_count());
  const Surface surface = visible_surface(topology);
  builder.add_triangles(surface, points);
  builder.add_edges(surface);
  builder.add_lines_and_dots(topology);
  return std::move(builder.mesh);
}

}  // namespace gmsim::io
