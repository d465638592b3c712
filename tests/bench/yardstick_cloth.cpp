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
  void add(Index i, Index j, double stiffness) {
    cloth_.springs.push_back(
        {i, j, stiffness, distance(cloth_.points[i], cloth_.points[j]), kDamping});
  }
  void add_face_springs() {
    for (const auto& face : cloth_.faces)
      for (std::size_t k = 0; k < face.size(); ++k)
        add(face[k], face[(k + 1) % face.size()], kStretch);
    for (const auto& face : cloth_.faces) {
      if (face.size() != 4) continue;
      add(face[0], face[2], kShear);
      add(face[1], face[3], kShear);
    }
  }
  /// The other neighbours of `from` and `to` along the face, for its side from -> to.
  struct Neighbours {
    Index of_from, of_to;
  };
  void add_bending_springs() {
    std::map<std::pair<Index, Index>, Neighbours> sides;
    for (const auto& face : cloth_.faces) {
      const std::size_t size = face.size();
      for (std::size_t k = 0; k < size; ++k)
        sides[{face[k], face[(k + 1) % size]}] = {face[(k + size - 1) % size],
                                                  face[(k + 2) % size]};
    }
    for (const auto& [side, here] : sides) {
      const auto other = sides.find({side.second, side.first});
      if (other == sides.end() || side.second < side.first) continue;
      add(here.of_from, other->second.of_to, kBend);
      add(here.of_to, other->second.of_from, kBend);
    }
  }

  Index n_;
  Cloth cloth_;
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
