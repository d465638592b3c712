// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "io/triangulate.h"

using namespace gmsim;
using Point = std::array<double, 3>;

namespace {

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

struct Plane {
  Point u, v, normal;
};

Plane random_plane(std::mt19937& random) {
  std::normal_distribution<> number;
  const auto unit = [](Point p) {
    const double length = std::sqrt(dot(p, p));
    for (double& x : p) x /= length;
    return p;
  };
  const Point normal = unit({number(random), number(random), number(random)});
  const Point u = unit(cross(normal, {number(random), number(random), number(random)}));
  return {u, cross(normal, u), normal};
}

/// A star around a centre: corners at rising angles, at any distance; as a rule not convex.
std::vector<Point> random_star(std::mt19937& random, const Plane& plane, std::size_t corners) {
  std::uniform_real_distribution<> distance(0.1, 1), jitter(0, 0.9);
  std::vector<Point> points;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle =
        2 * std::numbers::pi * (static_cast<double>(i) + jitter(random)) / static_cast<double>(corners);
    const double r = distance(random);
    Point point = {5, -3, 2};
    for (std::size_t axis = 0; axis < 3; ++axis)
      point[axis] += r * (std::cos(angle) * plane.u[axis] + std::sin(angle) * plane.v[axis]);
    points.push_back(point);
  }
  return points;
}

/// Of a polygon or triangle along a direction, by the triangles with its first corner.
double area(const std::vector<Point>& points, std::span<const std::int32_t> corners,
            const Point& normal) {
  double sum = 0;
  const auto at = [&](std::size_t i) { return points[static_cast<std::size_t>(corners[i])]; };
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    sum += dot(cross(minus(at(i), at(0)), minus(at(i + 1), at(0))), normal) / 2;
  return sum;
}

}  // namespace

TEST_CASE("triangles cover polygons that are not convex, without overlap") {
  for (std::uint32_t seed = 1; seed <= 500; ++seed) {
    std::mt19937 random(seed);
    const std::size_t corners = 3 + random() % 12;
    const Plane plane = random_plane(random);
    const std::vector<Point> points = random_star(random, plane, corners);
    std::vector<std::int32_t> polygon(corners);
    std::iota(polygon.begin(), polygon.end(), 0);
    std::vector<std::int32_t> triangles;
    io::triangulate(polygon, points, triangles);
    CAPTURE(seed);
    REQUIRE(triangles.size() == 3 * (corners - 2));
    double sum = 0;
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
      const double part = area(points, std::span(triangles).subspan(i, 3), plane.normal);
      CHECK(part > -1e-12);  // all are turned as the polygon is, so that none overlap
      sum += part;
    }
    CHECK(sum == doctest::Approx(area(points, polygon, plane.normal)));
  }
}

TEST_CASE("polygons without area still give as many triangles") {
  const std::vector<Point> points(6, Point{1, 2, 3});
  const std::vector<std::int32_t> polygon = {0, 1, 2, 3, 4, 5};
  std::vector<std::int32_t> triangles;
  io::triangulate(polygon, points, triangles);
  CHECK(triangles.size() == 12);
}
