// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/integrators/vertex_record_math.h"
#include "engine/simulation_implementation.h"

namespace gmsim::engine {
namespace {

/// `dt: auto` takes this part of the element-wise limit.
constexpr double kAutomaticShare = 0.9;
/// Adaptive methods stay below this part of the limit, else steps are rejected in turn at it.
constexpr double kAdaptiveShare = 0.9;
/// Substeps are at most this part of the limit, which may fall a little while the model moves.
constexpr double kSubstepShare = 0.95;

/// The norm in which adaptive methods measure errors, of a pair of rates at a state.
double scaled_norm(const std::vector<VertexRecord>& x, const std::vector<VertexRecord>& v,
                   const Motion& at, std::span<const double> inverse_mass,
                   const Tolerance& tolerance) {
  double sum = 0;
  std::size_t count = 0;
  const auto add = [&](double value, double size, double absolute) {
    const double ratio = value / (absolute + tolerance.relative * std::abs(size));
    sum += ratio * ratio;
    ++count;
  };
  for (std::size_t r = 0; r < x.size(); ++r) {
    if (inverse_mass[r] == 0) continue;
    const VertexRecord &p = at.position[r], &q = at.velocity[r];
    add(x[r].x, p.x, tolerance.position), add(v[r].x, q.x, tolerance.velocity);
    add(x[r].y, p.y, tolerance.position), add(v[r].y, q.y, tolerance.velocity);
    add(x[r].z, p.z, tolerance.position), add(v[r].z, q.z, tolerance.velocity);
  }
  return count == 0 ? 0 : std::sqrt(sum / static_cast<double>(count));
}

}  // namespace

bool Simulation::Implementation::find_limit(support::Diagnostics& diagnostics) {
  if (!estimator_.estimate(now_, equations_.inverse_mass(), limit_)) {
    diagnostics.report(failed_forces(settings_.dt));
    return false;
  }
  return true;
}

bool Simulation::Implementation::choose_step(support::Diagnostics& diagnostics) {
  if (info_->adaptive) return true;
  dt_ = settings_.dt;
  if (dt_ == 0) {
    if (!std::isfinite(limit_.dt)) {
      support::Diagnostic problem{support::DiagnosticKind::BadIntegrator,
                                  "nothing limits the time step, so it cannot be chosen",
                                  settings_.span};
      problem.help = "give `dt`; no interaction has a stiffness or a damping here";
      diagnostics.report(std::move(problem));
      return false;
    }
    dt_ = kAutomaticShare * limit_.dt;
    if (settings_.dt_max > 0) dt_ = std::min(dt_, settings_.dt_max);
    prescribed_.set_step(dt_);
  }
  return judge_step(diagnostics);
}

bool Simulation::Implementation::judge_step(support::Diagnostics& diagnostics) {
  if (settings_.on_unstable == OnUnstable::Substep) {
    substeps_ = substeps_for(dt_);
    return true;
  }
  if (dt_ <= limit_.dt) return true;
  support::Diagnostic problem = above_limit(dt_);
  const bool error =
      dt_ > limit_.dt_global && settings_.on_unstable == OnUnstable::Error;
  if (!error) problem.severity = support::Severity::Warning;
  diagnostics.report(std::move(problem));
  return !error;
}

std::uint32_t Simulation::Implementation::substeps_for(double dt) const {
  if (dt <= kSubstepShare * limit_.dt_global) return 1;
  return static_cast<std::uint32_t>(std::ceil(dt / (kSubstepShare * limit_.dt_global)));
}

double Simulation::Implementation::adaptive_cap() const {
  const double cap = kAdaptiveShare * limit_.dt_global;
  return settings_.dt_max > 0 ? std::min(cap, settings_.dt_max) : cap;
}

void Simulation::Implementation::choose_tolerance() {
  // Without a length in the model, a metre; without a frequency, a second.
  const double length = edges_.shortest() > 0 ? edges_.shortest() : 1;
  const double rate = limit_.omega_global > 0 ? limit_.omega_global : 1;
  tolerance_.relative = settings_.rtol;
  tolerance_.position = settings_.atol_position > 0
                            ? settings_.atol_position
                            : settings_.rtol * length;
  tolerance_.velocity =
      settings_.atol_velocity > 0 ? settings_.atol_velocity : rate * tolerance_.position;
}

bool Simulation::Implementation::choose_first_step(support::Diagnostics& diagnostics) {
  choose_tolerance();
  control_.set_next(std::min(settings_.dt, adaptive_cap()));
  if (settings_.dt > 0) return true;
  const std::span<const double> inverse_mass = equations_.inverse_mass();
  const auto norm = [&](const auto& x, const auto& v) {
    return scaled_norm(x, v, now_.motion, inverse_mass, tolerance_);
  };
  std::vector<VertexRecord> acceleration(now_.rows());
  for (std::size_t r = 0; r < now_.rows(); ++r) acceleration[r] = inverse_mass[r] * now_.force[r];
  const double d0 = norm(now_.motion.position, now_.motion.velocity);
  const double d1 = norm(now_.motion.velocity, acceleration);
  const double trial = std::min(trial_first_step(d0, d1), adaptive_cap());
  next_ = now_;
  for (std::size_t r = 0; r < now_.rows(); ++r) {
    next_.motion.position[r] = now_.motion.position[r] + trial * now_.motion.velocity[r];
    next_.motion.velocity[r] = now_.motion.velocity[r] + trial * acceleration[r];
  }
  if (!equations_.evaluate(next_.motion, now_.time + trial, trial, next_.force, Stage::Within)) {
    diagnostics.report(failed_forces(trial));
    return false;
  }
  for (std::size_t r = 0; r < now_.rows(); ++r) {
    next_.motion.velocity[r] = trial * acceleration[r];
    acceleration[r] = inverse_mass[r] * (next_.force[r] - now_.force[r]);
  }
  const double d2 = norm(next_.motion.velocity, acceleration) / trial;
  const double wish = first_step(trial, d1, d2, method_->embedded_order() + 1);
  control_.set_next(std::min(wish, adaptive_cap()));
  next_ = now_;
  return true;
}

}  // namespace gmsim::engine
