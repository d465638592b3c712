// SPDX-License-Identifier: MIT
#include "gmap/sew_facets.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "gmap/mesh_problems.h"

namespace gmsim::gmap {

namespace {

constexpr std::uint32_t kNoPoint = 0xffffffffu;

/// A facet with its points (at most four, kNoPoint beyond), ascending, which are the same for both
/// its cells.
struct KeyedFacet {
  std::array<std::uint32_t, 4> points;
  CellFacet facet;
};

/// The points as two numbers that compare quickly.
std::pair<std::uint64_t, std::uint64_t> key(const KeyedFacet& facet) {
  const auto& p = facet.points;
  return {std::uint64_t{p[0]} << 32 | p[1], std::uint64_t{p[2]} << 32 | p[3]};
}

bool same_points(const KeyedFacet& a, const KeyedFacet& b) {
  return key(a) == key(b);
}

bool sorts_before(const KeyedFacet& a, const KeyedFacet& b) {
  return same_points(a, b) ? a.facet.first < b.facet.first : key(a) < key(b);
}

KeyedFacet keyed(const MeshMap& built, const CellFacet& facet) {
  KeyedFacet keyed{{kNoPoint, kNoPoint, kNoPoint, kNoPoint}, facet};
  const std::uint32_t* const points = built.dart_point.data() + index(facet.first);
  const bool polygon = built.map.dimension() == 3;  // then every other dart is a corner
  const std::uint32_t count = polygon ? facet.darts / 2 : facet.darts;
  for (std::uint32_t i = 0; i < count; ++i) {  // insertion sort
    const std::uint32_t p = points[polygon ? 2 * i : i];
    std::uint32_t place = i;
    for (; place > 0 && keyed.points[place - 1] > p; --place) {
      keyed.points[place] = keyed.points[place - 1];
    }
    keyed.points[place] = p;
  }
  return keyed;
}

void sort_bucket(std::span<KeyedFacet> bucket) {
  if (bucket.size() > 16) return std::sort(bucket.begin(), bucket.end(), sorts_before);
  for (std::size_t i = 1; i < bucket.size(); ++i) {
    for (std::size_t k = i; k > 0 && sorts_before(bucket[k], bucket[k - 1]); --k) {
      std::swap(bucket[k], bucket[k - 1]);
    }
  }
}

/// Facets by ascending points: dealt out by their first point, then sorted in each small bucket.
std::vector<KeyedFacet> sorted_facets(const MeshMap& built, std::span<const CellFacet> facets) {
  std::vector<std::uint32_t> bucket_end(built.point_dart.size() + 1, 0);
  std::vector<KeyedFacet> keys, sorted(facets.size());
  keys.reserve(facets.size());
  for (const CellFacet& facet : facets) {
    keys.push_back(keyed(built, facet));
    ++bucket_end[keys.back().points[0] + 1];
  }
  for (std::size_t p = 1; p < bucket_end.size(); ++p) bucket_end[p] += bucket_end[p - 1];
  for (const KeyedFacet& facet : keys) sorted[bucket_end[facet.points[0]]++] = facet;
  for (std::size_t begin = 0; std::uint32_t end : bucket_end) {
    sort_bucket(std::span(sorted).subspan(begin, end - begin));
    begin = end;
  }
  return sorted;
}

/// The points of d and of the next one or two corners along the facet from d: they tell a dart from
/// all others of its facet and say how the corners are ordered.
std::array<std::uint32_t, 3> corner_order(const MeshMap& built, DartId d) {
  std::array<std::uint32_t, 3> order{built.dart_point[index(d)], kNoPoint, kNoPoint};
  if (built.map.dimension() == 1) return order;
  const DartId next = built.map.alpha(0, d);
  order[1] = built.dart_point[index(next)];
  if (built.map.dimension() == 2) return order;
  order[2] = built.dart_point[index(built.map.alpha(0, built.map.alpha(1, next)))];
  return order;
}

/// The dart of `facet` that lies on `d`; kNoDart when the corners are ordered differently.
DartId dart_upon(const MeshMap& built, DartId d, const CellFacet& facet) {
  const auto order = corner_order(built, d);
  for (std::uint32_t i = 0; i < facet.darts; ++i) {
    const DartId x{index(facet.first) + i};
    if (corner_order(built, x) == order) return x;
  }
  return kNoDart;
}

std::string describe(const MeshMap& built, std::span<const KeyedFacet> group) {
  std::vector<std::uint32_t> points, cells;
  for (std::uint32_t p : group[0].points) {
    if (p != kNoPoint) points.push_back(p);
  }
  for (const KeyedFacet& facet : group) {
    cells.push_back(built.dart_cell[index(facet.facet.first)]);
  }
  return fmt::format("{} (cells {})", join_numbers(points, "-"), join_numbers(cells, ", "));
}

const char* crowded_name(int dimension) {
  return dimension == 1   ? "points where more than two segments meet"
         : dimension == 2 ? "edges of more than two polygons"
                          : "faces of more than two solids";
}

}  // namespace

void sew_facets(MeshMap& built, std::span<const CellFacet> facets) {
  const int n = built.map.dimension();
  ProblemList crowded(true, crowded_name(n));
  ProblemList misfit(true, "faces whose two solids order the corners differently");
  const std::vector<KeyedFacet> sorted = sorted_facets(built, facets);
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
    while (end < sorted.size() && same_points(sorted[end], sorted[begin])) ++end;
    const auto group = std::span(sorted).subspan(begin, end - begin);
    if (group.size() > 2) crowded.add(describe(built, group));
    if (group.size() != 2) continue;
    const DartId d = group[0].facet.first, other = dart_upon(built, d, group[1].facet);
    if (other == kNoDart) {
      misfit.add(describe(built, group));
    } else {
      GMSIM_CHECK(built.map.sew(n, d, other), "facets with the same corners cannot be sewn");
    }
  }
  crowded.report(built.problems);
  misfit.report(built.problems);
}

}  // namespace gmsim::gmap
