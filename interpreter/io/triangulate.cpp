// SPDX-License-Identifier: MIT
#include "io/triangulate.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gmsim::io {

namespace {

using Point = std::array<double, 3>;
using Flat = std::array<double, 2>;

/// Newell's normal: its length is twice the area of the polygon.
Point area_vector(std::span<const std::int32_t> polygon, std::span<const Point> points) {
  Point normal = {};
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& a = points[static_cast<std::size_t>(polygon[i])];
    const Point& b = points[static_cast<std::size_t>(polygon[(i + 1) % polygon.size()])];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t next = (axis + 1) % 3, other = (axis + 2) % 3;
      normal[axis] += (a[next] - b[next]) * (a[other] + b[other]);
    }
  }
  return normal;
}

/// The corners without the coordinate along which the polygon has the largest shadow, swapped where
/// needed so that they run counterclockwise.
std::vector<Flat> flattened(std::span<const std::int32_t> polygon, std::span<const Point> points) {
  const Point normal = area_vector(polygon, points);
  std::size_t along = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
    if (std::abs(normal[axis]) > std::abs(normal[along])) along = axis;
  std::size_t x = (along + 1) % 3, y = (along + 2) % 3;
  if (normal[along] < 0) std::swap(x, y);
  std::vector<Flat> flat;
  for (const std::int32_t number : polygon) {
    const Point& point = points[static_cast<std::size_t>(number)];
    flat.push_back({point[x], point[y]});
  }
  return flat;
}

/// Twice the signed area of a triangle.
double turn(const Flat& a, const Flat& b, const Flat& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

bool contains(const Flat& a, const Flat& b, const Flat& c, const Flat& point) {
  return turn(a, b, point) >= 0 && turn(b, c, point) >= 0 && turn(c, a, point) >= 0;
}

/// Whether the corner at position `i` of what is `left` can be cut off.
bool is_ear(const std::vector<Flat>& corners, const std::vector<std::size_t>& left, std::size_t i) {
  const std::size_t count = left.size();
  const std::size_t before = left[(i + count - 1) % count], after = left[(i + 1) % count];
  const Flat &a = corners[before], &b = corners[left[i]], &c = corners[after];
  if (turn(a, b, c) <= 0) return false;
  return std::none_of(left.begin(), left.end(), [&](std::size_t other) {
    return other != before && other != left[i] && other != after &&
           contains(a, b, c, corners[other]);
  });
}

}  // namespace

void triangulate(std::span<const std::int32_t> polygon, std::span<const Point> points,
                 std::vector<std::int32_t>& triangles) {
  const std::vector<Flat> corners = flattened(polygon, points);
  std::vector<std::size_t> left(polygon.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
  while (left.size() >= 3) {
    std::size_t ear = 0;
    while (ear < left.size() && !is_ear(corners, left, ear)) ++ear;
    if (ear == left.size()) ear = 0;  // no area, or it crosses itself
    const std::size_t count = left.size();
    for (const std::size_t i : {(ear + count - 1) % count, ear, (ear + 1) % count})
      triangles.push_back(polygon[left[i]]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
}

}  // namespace gmsim::io
