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

Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vector unit(const Vector& a) {
  return 1 / std::sqrt(dot(a, a)) * a;
}

template <class Base>
class Scalar : public Base {
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
    first_stage();
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

 protected:
  /// The forces of the state that the step begins with.
  virtual void first_stage() { add_forces(vertices_); }
  void add_forces(const std::vector<Vertex>& at) {
    add_forces(at, [](std::size_t, const Vector&) {});
  }
  template <class Keep>
  void add_forces(const std::vector<Vertex>& at, const Keep& keep) {
    for (Vector& force : force_) force = {};
    for (std::size_t k = 0; k < springs_.size(); ++k) {
      const ClothSpring& spring = springs_[k];
      const Vector d = at[spring.j].x - at[spring.i].x, dv = at[spring.j].v - at[spring.i].v;
      const double length = std::sqrt(dot(d, d)), inverse = 1 / length;
      const double pull =
          spring.stiffness * (length - spring.rest) + spring.damping * dot(dv, d) * inverse;
      const Vector force = pull * inverse * d;
      force_[spring.i] = force_[spring.i] + force;
      force_[spring.j] = force_[spring.j] - force;
      keep(k, force);
    }
  }

  std::vector<ClothSpring> springs_;
  std::vector<Vertex> vertices_;
  std::vector<Vector> force_;

 private:
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

  std::vector<Vertex> stage_, sum_;  // sum_: of slopes
  std::vector<Vector> gravity_;
  std::vector<double> inverse_mass_;
};

class Judging final : public Scalar<JudgingCloth> {
 public:
  Judging(const Cloth& cloth, EdgeCriterion criterion, double threshold)
      : Scalar(cloth, cloth.springs),
        criterion_(criterion),
        threshold_(threshold),
        spring_corners_(cloth.spring_corners),
        edges_(cloth.edges),
        faces_(cloth.faces),
        spring_force_(cloth.springs.size()),
        normal_(cloth.faces.size()) {
    std::size_t corners = 0;
    for (const auto& face : faces_) corners += face.size();
    corner_.resize(corners);
  }

  [[nodiscard]] std::uint64_t fired() const override { return fired_; }
  [[nodiscard]] std::vector<double> values() override {
    std::vector<double> result;
    evaluate();
    judge([&](double value) { result.push_back(value); });
    return result;
  }

 private:
  void first_stage() override {
    evaluate();
    judge([&](double value) { fired_ += value > threshold_ ? 1 : 0; });
  }
  void evaluate() {
    if (criterion_ == EdgeCriterion::Global) return add_forces(vertices_);
    add_forces(vertices_, [&](std::size_t k, const Vector& force) { spring_force_[k] = force; });
    for (Vector& corner : corner_) corner = {};
    for (std::size_t k = 0; k < spring_force_.size(); ++k) {
      const auto [i, j] = spring_corners_[k];
      corner_[i] = corner_[i] + spring_force_[k];
      corner_[j] = corner_[j] - spring_force_[k];
    }
  }
  template <class Take>
  void judge(const Take& take) {
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      Vector area;
      const auto& face = faces_[f];
      for (std::size_t k = 0; k < face.size(); ++k)
        area = area + cross(vertices_[face[k]].x,
                            vertices_[face[k + 1 < face.size() ? k + 1 : 0]].x);
      normal_[f] = unit(area);
    }
    for (const ClothEdge& edge : edges_) {
      const Vector along = vertices_[edge.b].x - vertices_[edge.a].x;
      const Vector out = unit(cross(along, normal_[edge.face[0]] + normal_[edge.face[1]]));
      take(criterion_ == EdgeCriterion::Global
               ? std::abs(dot(force_[edge.a] + force_[edge.b], out))
               : pulled_apart(edge, out));
    }
  }
  [[nodiscard]] double pulled_apart(const ClothEdge& edge, const Vector& out) const {
    const double here = dot(corner_[edge.corner_a[0]] + corner_[edge.corner_b[0]], out);
    const double there = dot(corner_[edge.corner_a[1]] + corner_[edge.corner_b[1]], out);
    return here < 0 && there > 0 ? there - here : 0;
  }

  EdgeCriterion criterion_;
  double threshold_;
  std::vector<std::array<std::uint32_t, 2>> spring_corners_;
  std::vector<ClothEdge> edges_;
  std::vector<std::vector<std::uint32_t>> faces_;
  std::vector<Vector> spring_force_, corner_, normal_;
  std::uint64_t fired_ = 0;
};

}  // namespace

std::unique_ptr<ClothStepper> scalar_cloth(const Cloth& cloth) {
  return std::make_unique<Scalar<ClothStepper>>(cloth, cloth.springs);
}
std::unique_ptr<JudgingCloth> scalar_cloth(const Cloth& cloth, EdgeCriterion criterion,
                                           double threshold) {
  return std::make_unique<Judging>(cloth, criterion, threshold);
}
std::unique_ptr<ClothStepper> merged_cloth(const Cloth& cloth) {
  return std::make_unique<Scalar<ClothStepper>>(cloth, merged(cloth.springs));
}

}  // namespace gmsim::bench
