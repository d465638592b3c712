// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/integrators/vertex_record_math.h"
#include "engine/simulation_implementation.h"

namespace gmsim::engine {

void Simulation::Implementation::dense_positions(double time, std::vector<double>& out) const {
  out.resize(3 * now_.rows());
  const PhasePoint& from = next_;  // where the last step began
  const double h = now_.time - from.time;
  const bool inside = info_->adaptive && h > 0 && time < now_.time;
  const double s = inside ? std::max(0.0, (time - from.time) / h) : 1;
  // Quintic Hermite basis on [0, 1]: values, slopes and second derivatives of both ends.
  const double s3 = s * s * s, s4 = s3 * s, s5 = s4 * s;
  const double x1 = 10 * s3 - 15 * s4 + 6 * s5, x0 = 1 - x1;
  const double v0 = h * (s - 6 * s3 + 8 * s4 - 3 * s5), v1 = h * (-4 * s3 + 7 * s4 - 3 * s5);
  const double a0 = 0.5 * h * h * (s * s - 3 * s3 + 3 * s4 - s5);
  const double a1 = 0.5 * h * h * (s3 - 2 * s4 + s5);
  // Cubic, for vertices whose acceleration is not force over mass.
  const double c1 = s * s * (3 - 2 * s), c0 = 1 - c1;
  const double d0 = h * s * (1 - s) * (1 - s), d1 = h * s * s * (s - 1);
  for (std::size_t r = 0; r < now_.rows(); ++r) {
    const double w = equations_.inverse_mass()[r];
    VertexRecord x = now_.motion.position[r];
    if (inside && w > 0)
      x = x0 * from.motion.position[r] + x1 * x + v0 * from.motion.velocity[r] +
          v1 * now_.motion.velocity[r] + w * (a0 * from.force[r] + a1 * now_.force[r]);
    if (inside && w == 0)
      x = c0 * from.motion.position[r] + c1 * x + d0 * from.motion.velocity[r] +
          d1 * now_.motion.velocity[r];
    out[3 * r] = x.x;
    out[3 * r + 1] = x.y;
    out[3 * r + 2] = x.z;
  }
}

double Simulation::Implementation::free_kinetic_energy(const PhasePoint& point) const {
  double twice = 0;
  for (std::size_t r = 0; r < point.rows(); ++r)
    if (!held_[r]) twice += masses_.masses()[r] * dot(point.motion.velocity[r], point.motion.velocity[r]);
  return 0.5 * twice;
}

Totals Simulation::Implementation::totals() {
  Totals totals;
  forces_->potential_energy(now_.motion, now_.time, totals.potential);
  VertexRecord momentum, angular;
  for (std::size_t r = 0; r < now_.rows(); ++r) {
    const VertexRecord p = masses_.masses()[r] * now_.motion.velocity[r];
    totals.mass += masses_.masses()[r];
    totals.kinetic += 0.5 * dot(now_.motion.velocity[r], p);
    momentum = momentum + p;
    angular = angular + cross(now_.motion.position[r], p);
  }
  totals.momentum = {momentum.x, momentum.y, momentum.z};
  totals.angular_momentum = {angular.x, angular.y, angular.z};
  return totals;
}

void Simulation::Implementation::sync() {
  gmap::EmbeddingColumn& position = state_.store.column(position_);
  gmap::EmbeddingColumn& velocity = state_.store.column(velocity_);
  for (Row row = 0; row < now_.rows(); ++row) {
    if (!vertices().alive(row)) continue;
    const VertexRecord& x = now_.motion.position[row];
    const VertexRecord& v = now_.motion.velocity[row];
    position.set(row, std::array{x.x, x.y, x.z});
    velocity.set(row, std::array{v.x, v.y, v.z});
  }
  set_clock();
}

void Simulation::Implementation::set_clock() {
  state_.time = now_.time;
  state_.dt = dt();
  state_.step = steps_;
}

std::uint64_t Simulation::Implementation::state_hash() const {
  std::uint64_t hash = 0x243f6a8885a308d3ull;
  const auto add = [&](double number) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(number)) * 0x9e3779b97f4a7c15ull;
    hash ^= hash >> 29;
  };
  add(now_.time);
  for (Row row = 0; row < now_.rows(); ++row) {
    if (!vertices().alive(row)) continue;
    for (const VertexRecord* record : {&now_.motion.position[row], &now_.motion.velocity[row]}) {
      add(record->x);
      add(record->y);
      add(record->z);
    }
  }
  return hash;
}

std::string Simulation::Implementation::explain() const {
  std::string text = fmt::format("integrator {}: order {}, {} evaluations of all forces a step\n",
                                 info_->name, info_->order,
                                 info_->stages + (info_->name == "velocity_verlet" &&
                                                  forces_->reads_velocity()));
  if (info_->adaptive) {
    text += fmt::format("  steps from error: rtol {:.3g}, atol {:.3g} m and {:.3g} m/s, first {:.6g} s\n",
                        tolerance_.relative, tolerance_.position, tolerance_.velocity, dt());
  } else {
    text += fmt::format("  dt {:.6g} s", dt_);
    if (substeps_ > 1) text += fmt::format(" in {} substeps", substeps_);
    text += fmt::format(", {:.4g} of the stability limit\n", dt_ / substeps_ / limit_.dt_global);
    const double zeta = limit_.damping_ratio;
    const double growth = method_->growth(limit_.omega_global * dt_ / substeps_, zeta);
    text += fmt::format("  the stiffest mode keeps {:.6g} of its energy in a step\n",
                        growth * growth);
  }
  text += fmt::format("  limit {:.6g} s at {:.6g} rad/s, damping ratio {:.3g}; element-wise {:.6g} s at "
                      "{:.6g} rad/s\n",
                      limit_.dt_global, limit_.omega_global, limit_.damping_ratio, limit_.dt,
                      limit_.omega_bound);
  const std::string place = place_of_limit();
  if (!place.empty()) text += "  stiffest for its mass: " + place + "\n";
  const auto held = std::ranges::count(held_, true), fixed = std::ranges::count(fixed_, true);
  text += fmt::format("  vertices: {}, of them {} fixed and {} moved by decree\n",
                      vertices().orbit_count(), fixed, held - fixed);
  text += forces_->explain();
  if (changes_ == nullptr || !changes_->has_criteria()) return text;
  text += "criteria, judged once a step\n";
  for (const auto& field : changes_->criteria().fields()) text += field->explain();
  return text;
}

}  // namespace gmsim::engine
