// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "engine/integrators.h"
#include "engine/integrators/equations_of_motion.h"
#include "engine/integrators/phase_point.h"

namespace gmsim::engine {

/// What one component of the motion may be wrong by.
struct Tolerance {
  double relative = 0;
  double position = 0;  ///< m
  double velocity = 0;  ///< m/s
};

/// A method that advances x'' = M^-1 f(x, x', t). Work arrays are made by resize(); a step
/// allocates nothing.
class Integrator {
 public:
  virtual ~Integrator() = default;
  /// Makes room for `rows` vertices.
  virtual void resize(std::size_t rows) = 0;
  /// From `now`, whose force is known, to `next`, dt later, force included. False after a failed
  /// evaluation, which is in equations.error(); `now` is untouched.
  virtual bool advance(EquationsOfMotion& equations, const PhasePoint& now, double dt,
                       PhasePoint& next) = 0;
  /// Root mean square of the estimated error of the step just made, each component divided by what
  /// it may be: accept at most 1. Zero for methods without an estimate.
  [[nodiscard]] virtual double error_norm(const EquationsOfMotion& equations,
                                          const PhasePoint& now, const PhasePoint& next, double dt,
                                          const Tolerance& tolerance) const;
  /// Order of the solution that the error estimate compares with.
  [[nodiscard]] virtual int embedded_order() const { return 0; }
  /// By how much one step multiplies the amplitude of x'' = -omega^2 x - 2 zeta omega x', at
  /// z = omega dt: the spectral radius of the one-step matrix.
  [[nodiscard]] virtual double growth(double z, double zeta) const = 0;
};

/// A row of integrators.def as code.
[[nodiscard]] std::unique_ptr<Integrator> make_integrator(const IntegratorInfo& info);

}  // namespace gmsim::engine
