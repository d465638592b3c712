// SPDX-License-Identifier: MIT
#include <cmath>

#include "bench/yardstick.h"

namespace gmsim::bench {
namespace {

struct Vector {
  double x = 0, y = 0, z = 0;
};
Vector operator+(const Vector& a, const Vector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vector operator*(double s, const Vector& a) {
  return {s * a.x, s * a.y, s * a.z};
}
double dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

struct Vertex {
  Vector x, v;
};

class Scalar : public ClothStepper {
 public:
  Scalar(const Cloth& cloth, std::vector<ClothSpring> springs)
      : springs_(std::move(springs)), vertices_(cloth.points.size()) {
    for (std::size_t k = 0; k < vertices_.size(); ++k) {
      const auto& p = cloth.points[k];
      vertices_[k].x = {p[0], p[1], p[2]};
      inverse_mass_.push_back(1 / cloth.mass[k]);
    }
    gravity_.assign(vertices_.size(), {0, 0, -9.81});
    for (const std::uint32_t vertex : cloth.fixed) {
      inverse_mass_[vertex] = 0;
      gravity_[vertex] = {};
    }
    stage_.resize(vertices_.size());
    sum_.resize(vertices_.size());
    force_.resize(vertices_.size());
  }

  void step(double dt) override {
    add_forces(vertices_);
    for (std::size_t k = 0; k < vertices_.size(); ++k) {
      const Vector v = vertices_[k].v, a = acceleration(k);
      sum_[k] = {v, a};
      stage_[k] = {vertices_[k].x + 0.5 * dt * v, v + 0.5 * dt * a};
    }
    next_stage(0.5 * dt);
    next_stage(dt);
    add_forces(stage_);
    for (std::size_t k = 0; k < vertices_.size(); ++k) {
      vertices_[k].x = vertices_[k].x + dt / 6 * (sum_[k].x + stage_[k].v);
      vertices_[k].v = vertices_[k].v + dt / 6 * (sum_[k].v + acceleration(k));
    }
  }
  [[nodiscard]] std::array<double, 3> position(std::uint32_t vertex) const override {
    const Vector& x = vertices_[vertex].x;
    return {x.x, x.y, x.z};
  }

 private:
  void add_forces(const std::vector<Vertex>& at) {
    for (Vector& force : force_) force = {};
    for (const ClothSpring& spring : springs_) {
      const Vector d = at[spring.j].x - at[spring.i].x, dv = at[spring.j].v - at[spring.i].v;
      const double length = std::sqrt(dot(d, d)), inverse = 1 / length;
      const double pull =
          spring.stiffness * (length - spring.rest) + spring.damping * dot(dv, d) * inverse;
      const Vector force = pull * inverse * d;
      force_[spring.i] = force_[spring.i] + force;
      force_[spring.j] = force_[spring.j] - force;
    }
  }
  [[nodiscard]] Vector acceleration(std::size_t k) const {
    return inverse_mass_[k] * force_[k] + gravity_[k];
  }
  /// From the state of one stage to that of the next, `ahead` from the start of the step.
  void next_stage(double ahead) {
    add_forces(stage_);
    for (std::size_t k = 0; k < vertices_.size(); ++k) {
      const Vector v = stage_[k].v, a = acceleration(k);
      sum_[k] = {sum_[k].x + 2 * v, sum_[k].v + 2 * a};
      stage_[k] = {vertices_[k].x + ahead * v, vertices_[k].v + ahead * a};
    }
  }

  std::vector<ClothSpring> springs_;
  std::vector<Vertex> vertices_, stage_, sum_;  // sum_: of slopes
  std::vector<Vector> force_, gravity_;
  std::vector<double> inverse_mass_;
};

}  // namespace

std::unique_ptr<ClothStepper> scalar_cloth(const Cloth& cloth) {
  return std::make_unique<Scalar>(cloth, cloth.springs);
}
std::unique_ptr<ClothStepper> merged_cloth(const Cloth& cloth) {
  return std::make_unique<Scalar>(cloth, merged(cloth.springs));
}

}  // namespace gmsim::bench
