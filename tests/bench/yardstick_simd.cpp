// SPDX-License-Identifier: MIT
#include <cmath>

#include "bench/yardstick.h"

#if defined(__AVX__)
#include <immintrin.h>
#endif

namespace gmsim::bench {
namespace {

typedef double Four __attribute__((vector_size(32)));

/// Position and velocity with a pad each: one line of the cache.
struct alignas(64) Vertex {
  Four x = {}, v = {};
};

constexpr std::size_t kGroup = 8;
/// Eight springs; those that fill up the last group pull nothing.
struct alignas(64) Group {
  std::uint32_t i[kGroup], j[kGroup];
  Four stiffness[2] = {}, rest[2] = {}, damping[2] = {};
};

/// The x, y and z of four records.
struct Columns {
  Four x, y, z;
};
inline Columns columns(Four a, Four b, Four c, Four d) {
  const Four xz0 = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Four yw0 = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Four xz1 = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Four yw1 = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  return {__builtin_shufflevector(xz0, xz1, 0, 1, 4, 5),
          __builtin_shufflevector(yw0, yw1, 0, 1, 4, 5),
          __builtin_shufflevector(xz0, xz1, 2, 3, 6, 7)};
}
inline void records(const Columns& from, Four to[4]) {
  const Four zero = {};
  const Four xy0 = __builtin_shufflevector(from.x, from.y, 0, 4, 2, 6);
  const Four xy1 = __builtin_shufflevector(from.x, from.y, 1, 5, 3, 7);
  const Four zw0 = __builtin_shufflevector(from.z, zero, 0, 4, 2, 6);
  const Four zw1 = __builtin_shufflevector(from.z, zero, 1, 5, 3, 7);
  to[0] = __builtin_shufflevector(xy0, zw0, 0, 1, 4, 5);
  to[1] = __builtin_shufflevector(xy1, zw1, 0, 1, 4, 5);
  to[2] = __builtin_shufflevector(xy0, zw0, 2, 3, 6, 7);
  to[3] = __builtin_shufflevector(xy1, zw1, 2, 3, 6, 7);
}
inline Four dot(const Columns& a, const Columns& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
#if defined(__AVX__)
inline Four square_root(Four a) {
  return Four(_mm256_sqrt_pd(__m256d(a)));
}
#else
inline Four square_root(Four a) {
  return Four{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
}
#endif

class Simd : public ClothStepper {
 public:
  explicit Simd(const Cloth& cloth) : vertices_(cloth.points.size() + 2) {
    for (std::size_t k = 0; k < cloth.points.size(); ++k) {
      const auto& p = cloth.points[k];
      vertices_[k].x = Four{p[0], p[1], p[2], 0};
      inverse_mass_.push_back(1 / cloth.mass[k]);
    }
    // Two vertices that nobody sees, a meter apart, for the springs that fill up.
    vertices_.back().x[0] = 1;
    inverse_mass_.resize(vertices_.size());
    gravity_.assign(cloth.points.size(), Four{0, 0, -9.81, 0});
    gravity_.resize(vertices_.size());
    for (const std::uint32_t vertex : cloth.fixed) {
      inverse_mass_[vertex] = 0;
      gravity_[vertex] = Four{};
    }
    group_springs(merged(cloth.springs), static_cast<std::uint32_t>(cloth.points.size()));
    stage_.resize(vertices_.size());
    sum_.resize(vertices_.size());
    force_.resize(vertices_.size());
  }

  void step(double dt) override {
    add_forces(vertices_);
    for (std::size_t k = 0; k < vertices_.size(); ++k) {
      const Four v = vertices_[k].v, a = acceleration(k);
      sum_[k] = {v, a};
      stage_[k] = {vertices_[k].x + 0.5 * dt * v, v + 0.5 * dt * a};
    }
    next_stage(0.5 * dt);
    next_stage(dt);
    add_forces(stage_);
    for (std::size_t k = 0; k < vertices_.size(); ++k) {
      vertices_[k].x += dt / 6 * (sum_[k].x + stage_[k].v);
      vertices_[k].v += dt / 6 * (sum_[k].v + acceleration(k));
    }
  }
  [[nodiscard]] std::array<double, 3> position(std::uint32_t vertex) const override {
    const Four& x = vertices_[vertex].x;
    return {x[0], x[1], x[2]};
  }

 private:
  void group_springs(const std::vector<ClothSpring>& springs, std::uint32_t spare) {
    for (std::size_t first = 0; first < springs.size(); first += kGroup) {
      Group group;
      for (std::size_t k = 0; k < kGroup; ++k) {
        const bool any = first + k < springs.size();
        const ClothSpring spring =
            any ? springs[first + k] : ClothSpring{spare, spare + 1, 0, 1, 0};
        group.i[k] = spring.i;
        group.j[k] = spring.j;
        group.stiffness[k / 4][k % 4] = spring.stiffness;
        group.rest[k / 4][k % 4] = spring.rest;
        group.damping[k / 4][k % 4] = spring.damping;
      }
      groups_.push_back(group);
    }
  }
  void add_forces(const std::vector<Vertex>& at) {
    for (Four& force : force_) force = Four{};
    for (const Group& group : groups_) {
      Four pulls[kGroup];
      for (std::size_t half = 0; half < 2; ++half) {
        const std::uint32_t *i = group.i + 4 * half, *j = group.j + 4 * half;
        const Columns d = columns(at[j[0]].x - at[i[0]].x, at[j[1]].x - at[i[1]].x,
                                  at[j[2]].x - at[i[2]].x, at[j[3]].x - at[i[3]].x);
        const Columns dv = columns(at[j[0]].v - at[i[0]].v, at[j[1]].v - at[i[1]].v,
                                   at[j[2]].v - at[i[2]].v, at[j[3]].v - at[i[3]].v);
        const Four length = square_root(dot(d, d)), inverse = 1 / length;
        const Four pull = (group.stiffness[half] * (length - group.rest[half]) +
                           group.damping[half] * dot(dv, d) * inverse) *
                          inverse;
        records({pull * d.x, pull * d.y, pull * d.z}, pulls + 4 * half);
      }
      for (std::size_t k = 0; k < kGroup; ++k) {
        force_[group.i[k]] += pulls[k];
        force_[group.j[k]] -= pulls[k];
      }
    }
  }
  [[nodiscard]] Four acceleration(std::size_t k) const {
    return inverse_mass_[k] * force_[k] + gravity_[k];
  }
  void next_stage(double ahead) {
    add_forces(stage_);
    for (std::size_t k = 0; k < vertices_.size(); ++k) {
      const Four v = stage_[k].v, a = acceleration(k);
      sum_[k] = {sum_[k].x + 2 * v, sum_[k].v + 2 * a};
      stage_[k] = {vertices_[k].x + ahead * v, vertices_[k].v + ahead * a};
    }
  }

  std::vector<Group> groups_;
  std::vector<Vertex> vertices_, stage_, sum_;  // sum_: of slopes
  std::vector<Four> force_, gravity_;
  std::vector<double> inverse_mass_;
};

}  // namespace

std::unique_ptr<ClothStepper> simd_cloth(const Cloth& cloth) {
  return std::make_unique<Simd>(cloth);
}

}  // namespace gmsim::bench
