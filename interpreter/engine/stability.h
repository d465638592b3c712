// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "engine/force_field.h"
#include "engine/integrators/integrator.h"
#include "engine/stability_limit.h"

namespace gmsim::engine {

/// The step at which a mode x'' = -omega^2 x - damping x' first grows; infinite when it never does.
/// omega in rad/s, damping in 1/s.
[[nodiscard]] double step_limit(const Integrator& method, double omega, double damping);
/// The largest step at which no mode grows that is slower and less damped than these bounds.
[[nodiscard]] double step_limit_within(const Integrator& method, double omega, double damping);

/// Bounds and estimates of the largest stable step of a force field.
///
/// The element-wise bound takes each match with its own corner masses: it is above the true highest
/// frequency always, after any tear too, and usually by a factor of 1.3 to 2. Any damping up to the
/// bound may go with any frequency.
///
/// The global estimate looks at three modes of M^-1/2 K M^-1/2 and M^-1/2 C M^-1/2 as they are at
/// this motion: the stiffest, the softest and the most damped one, each with its own stiffness and
/// damping. That is exact for damping in proportion to stiffness, to mass, or to both.
class StabilityEstimator {
 public:
  StabilityEstimator(ForceField& field, const Integrator& method)
      : field_(field), method_(method) {}

  /// False when the force field failed; its error() says why.
  bool estimate(const PhasePoint& point, std::span<const double> inverse_mass,
                StabilityLimit& limit);
  /// A look at the stiffest mode of the last estimate, for two products: has it become stiffer by
  /// 2 % or more?
  [[nodiscard]] bool has_stiffened(const PhasePoint& point, std::span<const double> inverse_mass);
  /// A look at the modes of these vertices, after the map has changed there, for a few products: is
  /// one of them stiffer by 2 % or more than the stiffest mode of the last estimate?
  [[nodiscard]] bool has_stiffened_at(std::span<const Row> vertices, const PhasePoint& point,
                                      std::span<const double> inverse_mass);

 private:
  void global_limit(const PhasePoint& point, std::span<const double> inverse_mass,
                    StabilityLimit& limit);

  ForceField& field_;
  const Integrator& method_;
  std::vector<VertexRecord> top_;  // the stiffest mode, of length 1, times the root of the mass
  double top_stiffness_ = 0;       // 1/s^2
};

}  // namespace gmsim::engine
