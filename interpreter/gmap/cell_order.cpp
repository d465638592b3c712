// SPDX-License-Identifier: MIT
#include "gmap/cell_order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace gmsim::gmap {

namespace {

// All that a step reads of fewer cells stays in the cache.
constexpr std::size_t kFewCells = 4096;
// Another order is taken where it brings the points of a cell closer together by this much.
constexpr double kClearGain = 2;
constexpr int kBits = 21;  // of each coordinate

using Point = std::array<double, 3>;

bool in_order(const Mesh& mesh) {
  const auto finite = [](const Point& p) {
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
  };
  return std::ranges::all_of(mesh.points, finite) &&
         std::ranges::all_of(mesh.cell_points,
                             [&](std::uint32_t point) { return point < mesh.points.size(); });
}

/// The lowest bits of a number, two zeros between each.
std::uint64_t spread_out(std::uint64_t bits) {
  bits = (bits | bits << 32) & 0x001f00000000ffffu;
  bits = (bits | bits << 16) & 0x001f0000ff0000ffu;
  bits = (bits | bits << 8) & 0x100f00f00f00f00fu;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3u;
  return (bits | bits << 2) & 0x1249249249249249u;
}

std::vector<std::uint64_t> morton_codes(const Mesh& mesh) {
  Point low = mesh.points.front(), high = low;
  for (const Point& p : mesh.points)
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2],
                                  std::numeric_limits<double>::min()});
  std::vector<std::uint64_t> codes(mesh.cell_count());
  for (std::size_t cell = 0; cell < codes.size(); ++cell) {
    const auto corners = mesh.corners(cell);
    for (int k = 0; k < 3; ++k) {
      double centre = 0;
      for (const std::uint32_t corner : corners)
        centre += (mesh.points[corner][k] - low[k]) / static_cast<double>(corners.size());
      const double part = std::clamp(centre / extent, 0.0, 1.0);
      codes[cell] |= spread_out(static_cast<std::uint64_t>(part * ((1 << kBits) - 1))) << k;
    }
  }
  return codes;
}

/// How far apart the points of a cell stand on average, when points are numbered as the cells in this
/// order meet them.
double mean_distance(const Mesh& mesh, std::span<const std::uint32_t> order) {
  constexpr std::uint32_t kUnmet = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(mesh.points.size(), kUnmet);
  std::uint32_t next = 0;
  double sum = 0;
  for (const std::uint32_t cell : order) {
    std::uint32_t low = kUnmet, high = 0;
    for (const std::uint32_t point : mesh.corners(cell)) {
      if (number[point] == kUnmet) number[point] = next++;
      low = std::min(low, number[point]);
      high = std::max(high, number[point]);
    }
    sum += high - low;
  }
  return sum / static_cast<double>(order.size());
}

}  // namespace

std::vector<std::uint32_t> cell_order(const Mesh& mesh) {
  if (mesh.cell_count() < kFewCells || !in_order(mesh)) return {};
  std::vector<std::uint32_t> given(mesh.cell_count());
  std::iota(given.begin(), given.end(), 0u);
  const std::vector<std::uint64_t> codes = morton_codes(mesh);
  std::vector<std::uint32_t> along_curve = given;
  std::ranges::stable_sort(along_curve, {}, [&](std::uint32_t cell) { return codes[cell]; });
  if (mean_distance(mesh, given) < kClearGain * mean_distance(mesh, along_curve)) return {};
  return along_curve;
}

}  // namespace gmsim::gmap
