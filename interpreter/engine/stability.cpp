// SPDX-License-Identifier: MIT
#include "engine/stability.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/integrators/vertex_record_math.h"
#include "engine/stability_lanczos.h"

namespace gmsim::engine {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Lanczos' value comes from below.
constexpr double kSafety = 1.01;
constexpr std::uint32_t kMostProducts = 120;
constexpr std::uint32_t kLocalProducts = 8;
/// Less than this is no other mode.
constexpr double kStiffer = 1.02;
/// Growth that is rounding.
constexpr double kNeutral = 1 + 1e-9;

bool grows(const Integrator& method, double dt, double omega, double damping) {
  return method.growth(omega * dt, 0.5 * damping / omega) > kNeutral;
}

/// The two quadratic forms of the linearised model in coordinates y = M^1/2 x.
class LinearisedModel {
 public:
  LinearisedModel(ForceField& field, const PhasePoint& point, std::span<const double> inverse_mass)
      : field_(field), point_(point), root_(inverse_mass.size()), still_(inverse_mass.size()),
        moved_(inverse_mass.size()) {
    for (std::size_t r = 0; r < root_.size(); ++r) root_[r] = std::sqrt(inverse_mass[r]);
  }
  [[nodiscard]] SymmetricOperator stiffness() {
    return [this](std::span<const VertexRecord> in, std::span<VertexRecord> out) {
      return apply(in, out, true);
    };
  }
  [[nodiscard]] SymmetricOperator damping() {
    return [this](std::span<const VertexRecord> in, std::span<VertexRecord> out) {
      return apply(in, out, false);
    };
  }

 private:
  bool apply(std::span<const VertexRecord> in, std::span<VertexRecord> out, bool stiffness) {
    for (std::size_t r = 0; r < in.size(); ++r) moved_[r] = root_[r] * in[r];
    const std::span<const VertexRecord> still = still_, moved = moved_;
    if (!field_.product(point_.motion, point_.time, stiffness ? moved : still,
                        stiffness ? still : moved, out))
      return false;
    for (std::size_t r = 0; r < in.size(); ++r) out[r] = -root_[r] * out[r];
    return true;
  }

  ForceField& field_;
  const PhasePoint& point_;
  std::vector<double> root_;
  std::vector<VertexRecord> still_, moved_;
};

}  // namespace

double step_limit(const Integrator& method, double omega, double damping) {
  // A mode without stiffness is one that is very soft beside its damping.
  omega = std::max(omega, 1e-6 * damping);
  if (!(omega > 0)) return kInfinity;
  if (std::isinf(omega)) return 0;
  // In units of the mode's own rates, all methods here have their limit below 16.
  const double unit = 1 / (omega + damping);
  constexpr double kScan = 0.02, kEnd = 16;
  for (double s = kScan; s <= kEnd; s += kScan) {
    if (!grows(method, s * unit, omega, damping)) continue;
    double low = s - kScan, high = s;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      (grows(method, middle * unit, omega, damping) ? high : low) = middle;
    }
    return low * unit;
  }
  return kInfinity;
}

double step_limit_within(const Integrator& method, double omega, double damping) {
  if (damping == 0) return step_limit(method, omega, 0);
  // A smaller mode is a point of a ray through the outer edges of the box [0, omega] x [0, damping].
  constexpr int kRays = 12;
  double limit = kInfinity;
  for (int i = 0; i <= kRays; ++i) {
    const double part = static_cast<double>(i) / kRays;
    limit = std::min({limit, step_limit(method, omega, part * damping),
                      step_limit(method, part * omega, damping)});
  }
  return limit;
}

bool StabilityEstimator::estimate(const PhasePoint& point, std::span<const double> inverse_mass,
                                  StabilityLimit& limit) {
  ForceField::ElementBound bound;
  if (!field_.element_bound(point.motion, point.time, bound)) return false;
  limit = {};
  limit.omega_bound = std::sqrt(std::max(bound.stiffness, 0.0));
  limit.dt = step_limit_within(method_, limit.omega_bound, std::max(bound.damping, 0.0));
  limit.where = bound.where;
  limit.interaction = bound.interaction;
  global_limit(point, inverse_mass, limit);
  // Stiff elements on corners without mass (of held vertices) bound nothing.
  const bool bounded = std::isfinite(bound.stiffness) && std::isfinite(bound.damping);
  limit.dt = bounded ? std::min(limit.dt, limit.dt_global) : limit.dt_global;
  return true;
}

void StabilityEstimator::global_limit(const PhasePoint& point,
                                      std::span<const double> inverse_mass,
                                      StabilityLimit& limit) {
  LinearisedModel model(field_, point, inverse_mass);
  SpectrumEnds stiffness = spectrum_ends(model.stiffness(), inverse_mass, kMostProducts);
  if (!stiffness.known) {  // nothing better is known
    limit.omega_global = limit.omega_bound;
    limit.dt_global = limit.dt;
    return;
  }
  const auto mode_limit = [&](double square, double damping) {
    return step_limit(method_, std::sqrt(kSafety * std::max(square, 0.0)),
                      kSafety * std::max(damping, 0.0));
  };
  limit.omega_global = std::sqrt(kSafety * std::max(stiffness.largest, 0.0));
  limit.dt_global = kInfinity;
  double top_damping = 0;
  if (field_.reads_velocity()) {
    const SpectrumEnds damping = spectrum_ends(model.damping(), inverse_mass, kMostProducts);
    if (damping.known) {
      top_damping = rayleigh_quotient(model.damping(), stiffness.top);
      limit.dt_global = std::min(
          mode_limit(stiffness.smallest, rayleigh_quotient(model.damping(), stiffness.bottom)),
          mode_limit(rayleigh_quotient(model.stiffness(), damping.top), damping.largest));
    }
  }
  limit.dt_global = std::min(limit.dt_global, mode_limit(stiffness.largest, top_damping));
  if (limit.omega_global > 0) limit.damping_ratio = 0.5 * top_damping / limit.omega_global;
  top_ = std::move(stiffness.top);
  top_stiffness_ = stiffness.largest;
}

bool StabilityEstimator::has_stiffened(const PhasePoint& point,
                                       std::span<const double> inverse_mass) {
  if (top_.size() != inverse_mass.size() || top_stiffness_ <= 0) return true;
  LinearisedModel model(field_, point, inverse_mass);
  const SymmetricOperator stiffness = model.stiffness();
  std::vector<VertexRecord> turned(top_.size());
  if (!stiffness(top_, turned)) return true;
  double square = 0;
  for (const VertexRecord& record : turned) square += dot(record, record);
  if (square == 0) return false;
  for (std::size_t r = 0; r < top_.size(); ++r) top_[r] = 1 / std::sqrt(square) * turned[r];
  return rayleigh_quotient(stiffness, top_) > kStiffer * top_stiffness_;
}

bool StabilityEstimator::has_stiffened_at(std::span<const Row> vertices, const PhasePoint& point,
                                          std::span<const double> inverse_mass) {
  if (top_stiffness_ <= 0) return true;
  top_.resize(inverse_mass.size());  // new vertices take no part in the old mode
  std::vector<double> start(inverse_mass.size(), 0.0);
  for (const Row vertex : vertices) start[vertex] = inverse_mass[vertex];
  LinearisedModel model(field_, point, inverse_mass);
  return largest_eigenvalue(model.stiffness(), start, kLocalProducts) > kStiffer * top_stiffness_;
}

}  // namespace gmsim::engine
