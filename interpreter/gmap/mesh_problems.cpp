// SPDX-License-Identifier: MIT
#include "gmap/mesh_problems.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gmap/cell_measure.h"
#include "gmap/solid_shape.h"

namespace gmsim::gmap {

namespace {

using Corners = std::span<const std::uint32_t>;

constexpr double kNoMeasure = 1e-13;  // of extent^dimension: well above rounding

bool fits(Mesh::CellKind kind, int dimension, std::size_t corners) {
  switch (kind) {
    case Mesh::CellKind::Segment:
      return dimension == 1 && corners == 2;
    case Mesh::CellKind::Polygon:
      return dimension == 2 && corners >= 3;
    case Mesh::CellKind::Tetrahedron:
      return dimension == 3 && corners == 4;
    case Mesh::CellKind::Hexahedron:
      return dimension == 3 && corners == 8;
    case Mesh::CellKind::Prism:
      return dimension == 3 && corners == 6;
    case Mesh::CellKind::Pyramid:
      return dimension == 3 && corners == 5;
  }
  return false;
}

bool finite(const std::array<double, 3>& p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

/// The problems of single cells, by kind.
struct CellProblems {
  explicit CellProblems(int dimension)
      : no_measure(true, dimension == 1   ? "segments without length"
                         : dimension == 2 ? "polygons without area"
                                          : "solids without volume") {}

  ProblemList misfit{true, "cells with a kind or number of corners that does not fit"};
  ProblemList beyond{true, "cells with a point number beyond the last point"};
  ProblemList not_finite{true, "points with a coordinate that is not finite"};
  ProblemList repeats{true, "cells that repeat a point"};
  ProblemList no_measure;
  ProblemList turned{false, "solids of negative volume, turned round"};
  ProblemList unused{false, "points used by no cell"};

  void report(std::vector<MeshProblem>& problems) const {
    for (const ProblemList* list :
         {&misfit, &beyond, &not_finite, &repeats, &no_measure, &turned, &unused}) {
      list->report(problems);
    }
  }
};

/// A corner that the cell has twice; one past the points when there is none.
std::uint32_t repeated_point(const Mesh& mesh, Corners corners) {
  if (corners.size() <= 8) {
    for (std::size_t i = 1; i < corners.size(); ++i) {
      if (std::find(corners.begin(), corners.begin() + i, corners[i]) != corners.begin() + i) {
        return corners[i];
      }
    }
    return static_cast<std::uint32_t>(mesh.points.size());
  }
  std::vector<std::uint32_t> sorted(corners.begin(), corners.end());
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  return twice == sorted.end() ? static_cast<std::uint32_t>(mesh.points.size()) : *twice;
}

/// True when the corners of the cell can be worked with.
bool check_corners(const Mesh& mesh, std::size_t cell, CellProblems& problems) {
  const Corners corners = mesh.corners(cell);
  if (!fits(mesh.kinds[cell], mesh.dimension, corners.size())) {
    problems.misfit.add(fmt::format("{} ({} corners)", cell, corners.size()));
    return false;
  }
  for (std::uint32_t p : corners) {
    if (p < mesh.points.size()) continue;
    problems.beyond.add(fmt::format("{} (point {})", cell, p));
    return false;
  }
  const std::uint32_t twice = repeated_point(mesh, corners);
  if (twice < mesh.points.size()) problems.repeats.add(fmt::format("{} (point {})", cell, twice));
  return twice == mesh.points.size();
}

/// extent^dimension: what the measure of a well-shaped cell is comparable to.
double measure_scale(const Mesh& mesh, std::size_t cell) {
  const double length = cell_extent(mesh, cell);
  return mesh.dimension == 1   ? length
         : mesh.dimension == 2 ? length * length
                               : length * length * length;
}

void turn_round(Mesh::CellKind kind, std::span<std::uint32_t> corners) {
  const std::vector<std::uint32_t> old(corners.begin(), corners.end());
  const auto mirrored = mirrored_corners(kind);
  for (std::size_t c = 0; c < corners.size(); ++c) corners[c] = old[mirrored[c]];
}

void check_points(const Mesh& mesh, CellProblems& problems) {
  std::vector<bool> used(mesh.points.size(), false);
  for (std::uint32_t p : mesh.cell_points) {
    if (p < used.size()) used[p] = true;
  }
  for (std::size_t p = 0; p < used.size(); ++p) {
    if (!used[p]) problems.unused.add(p);
    if (used[p] && !finite(mesh.points[p])) problems.not_finite.add(p);
  }
}

}  // namespace

void ProblemList::report(std::vector<MeshProblem>& problems) const {
  if (empty()) return;
  std::string message = fmt::format("{}: {}", what_, fmt::join(items_, ", "));
  if (count_ > items_.size()) message += fmt::format(", … ({} in all)", count_);
  problems.push_back({fatal_, std::move(message)});
}

std::string join_numbers(const std::vector<std::uint32_t>& numbers, const char* separator) {
  return fmt::format("{}", fmt::join(numbers, separator));
}

std::vector<std::uint32_t> check_cells(const Mesh& mesh, std::vector<MeshProblem>& problems) {
  GMSIM_CHECK(mesh.cell_begin.size() == mesh.kinds.size() + 1, "mesh with a broken cell table");
  std::vector<std::uint32_t> cell_points = mesh.cell_points;
  CellProblems found(mesh.dimension);
  check_points(mesh, found);
  for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
    if (!check_corners(mesh, cell, found) || !found.not_finite.empty()) continue;
    const double size = signed_cell_measure(mesh, cell);
    if (std::abs(size) <= kNoMeasure * measure_scale(mesh, cell)) {
      found.no_measure.add(cell);
    } else if (size < 0.0) {
      found.turned.add(cell);
      turn_round(mesh.kinds[cell],
                 std::span(cell_points).subspan(mesh.cell_begin[cell], mesh.corners(cell).size()));
    }
  }
  found.report(problems);
  return cell_points;
}

}  // namespace gmsim::gmap
