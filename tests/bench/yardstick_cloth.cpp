// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "bench/yardstick.h"

namespace gmsim::bench {
namespace {

using Index = std::uint32_t;
using Point = std::array<double, 3>;

constexpr double kStretch = 60, kShear = 43, kBend = 10;  // N/m
constexpr double kDamping = 0.1;                          // N s/m
constexpr double kMass = 0.1;                             // kg

double distance(const Point& a, const Point& b) {
  return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
}

class Builder {
 public:
  Builder(ClothMesh mesh, Index n) : n_(n) {
    for (Index j = 0; j <= n; ++j)
      for (Index i = 0; i <= n; ++i) cloth_.points.push_back({double(i) / n, double(j) / n, 0});
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i)
        patch(i, j, mesh == ClothMesh::Tri4 || (mesh == ClothMesh::Mix4 && (i + j) % 2 == 1));
    cloth_.fixed = {n * (n + 1), n * (n + 1) + n};
    share_mass();
    number_corners();
    add_face_springs();
    add_bending_springs();
  }
  Cloth take() { return std::move(cloth_); }

 private:
  void patch(Index i, Index j, bool cone) {
    const Index a = j * (n_ + 1) + i;
    const std::array<Index, 4> corners = {a, a + 1, a + n_ + 2, a + n_ + 1};
    if (!cone) return cloth_.faces.emplace_back(corners.begin(), corners.end()), void();
    const auto tip = static_cast<Index>(cloth_.points.size());
    cloth_.points.push_back({(i + 0.5) / n_, (j + 0.5) / n_, 0});
    for (int k = 0; k < 4; ++k) cloth_.faces.push_back({corners[k], corners[(k + 1) % 4], tip});
  }
  void share_mass() {
    cloth_.mass.resize(cloth_.points.size());
    for (const auto& face : cloth_.faces) {
      const double patch_mass = kMass / (double(n_) * n_);
      const double mass = face.size() == 4 ? patch_mass : patch_mass / 4;
      for (const Index vertex : face)
        cloth_.mass[vertex] += mass / static_cast<double>(face.size());
    }
  }
  /// A vertex as a corner of a face.
  struct Corner {
    Index vertex, number;
  };
  void number_corners() {
    Index next = 0;
    for (const auto& face : cloth_.faces) {
      first_corner_.push_back(next);
      next += static_cast<Index>(face.size());
    }
  }
  [[nodiscard]] Corner corner(Index face, std::size_t k) const {
    const auto& vertices = cloth_.faces[face];
    const auto around = static_cast<Index>(k % vertices.size());
    return {vertices[around], first_corner_[face] + around};
  }
  void add(Corner i, Corner j, double stiffness) {
    const double rest = distance(cloth_.points[i.vertex], cloth_.points[j.vertex]);
    cloth_.springs.push_back({i.vertex, j.vertex, stiffness, rest, kDamping});
    cloth_.spring_corners.push_back({i.number, j.number});
  }
  void add_face_springs() {
    const auto faces = static_cast<Index>(cloth_.faces.size());
    for (Index face = 0; face < faces; ++face)
      for (std::size_t k = 0; k < cloth_.faces[face].size(); ++k)
        add(corner(face, k), corner(face, k + 1), kStretch);
    for (Index face = 0; face < faces; ++face) {
      if (cloth_.faces[face].size() != 4) continue;
      add(corner(face, 0), corner(face, 2), kShear);
      add(corner(face, 1), corner(face, 3), kShear);
    }
  }
  /// A face's side from -> to, and the other neighbours of both along the face.
  struct Side {
    Index face;
    Corner from, to, before, after;
  };
  void add_bending_springs() {
    std::map<std::pair<Index, Index>, Side> sides;
    for (Index face = 0; face < cloth_.faces.size(); ++face) {
      const std::size_t size = cloth_.faces[face].size();
      for (std::size_t k = 0; k < size; ++k)
        sides[{corner(face, k).vertex, corner(face, k + 1).vertex}] = {
            face, corner(face, k), corner(face, k + 1), corner(face, k + size - 1),
            corner(face, k + 2)};
    }
    for (const auto& [side, here] : sides) {
      const auto other = sides.find({side.second, side.first});
      if (other == sides.end() || side.second < side.first) continue;
      const Side& there = other->second;
      add(here.before, there.after, kBend);
      add(here.after, there.before, kBend);
      cloth_.edges.push_back({side.first, side.second, {here.face, there.face},
                              {here.from.number, there.to.number},
                              {here.to.number, there.from.number}});
    }
  }

  Index n_;
  Cloth cloth_;
  std::vector<Index> first_corner_;  // of each face
};

}  // namespace

Cloth paper_cloth(ClothMesh mesh, std::uint32_t n) {
  return Builder(mesh, n).take();
}

std::vector<ClothSpring> merged(const std::vector<ClothSpring>& springs) {
  std::map<std::pair<Index, Index>, ClothSpring> sums;
  for (const ClothSpring& spring : springs) {
    const auto [low, high] = std::minmax(spring.i, spring.j);
    ClothSpring& sum = sums[{low, high}];
    sum.i = low;
    sum.j = high;
    sum.rest = spring.rest;
    sum.stiffness += spring.stiffness;
    sum.damping += spring.damping;
  }
  std::vector<ClothSpring> result;
  for (const auto& [ends, spring] : sums) result.push_back(spring);
  return result;
}

}  // namespace gmsim::bench
