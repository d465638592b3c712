// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "engine/force_field.h"
#include "engine/integrators/clock_expression.h"
#include "engine/integrators/phase_point.h"
#include "engine/model.h"

namespace gmsim::engine {

/// The vertices that move by decree. Where `position` is prescribed, velocity is its derivative;
/// where `velocity` is, positions are its integral from where the step began, by Gauss-Legendre
/// quadrature with five points (exact for polynomials in time of degree 9).
class PrescribedMotions {
 public:
  /// Nothing is prescribed.
  PrescribedMotions() = default;
  /// Errors (a vertex that is moved twice, an expression without a value) are in error().
  PrescribedMotions(State& state, const std::vector<PrescribedMotion>& motions);

  [[nodiscard]] bool empty() const { return drivers_.empty(); }
  /// The rows that are moved, ascending.
  [[nodiscard]] std::vector<gmap::Row> rows() const;
  /// The length of a usual step: derivatives are taken over a part of it.
  void set_step(double dt) { step_ = dt; }

  /// Looks the vertices up anew after the map has changed: all parts of a vertex move on.
  void follow(const State& state);
  void begin_step(const PhasePoint& now);
  /// Positions and velocities at `time`. False after a failure.
  bool apply(double time, Motion& motion);
  [[nodiscard]] const std::optional<support::Diagnostic>& error() const { return error_; }

 private:
  struct Driver {
    std::vector<DartId> darts;  // all of its vertices
    std::vector<gmap::Row> rows;
    bool gives_position = false;
    ClockExpression function;
    std::vector<VertexRecord> from = {};  // where the step began, by row; when velocity is given
    double from_time = 0;
    // What the function gave last; stages of a step often share a time.
    double time = std::numeric_limits<double>::quiet_NaN();
    std::array<double, 3> moved = {};     // position, or the way since the step began
    std::array<double, 3> velocity = {};
  };
  bool evaluate(Driver& driver, double time);
  bool integrate(Driver& driver, double time);

  std::vector<Driver> drivers_;
  double step_ = 1e-3;  // s
  std::optional<support::Diagnostic> error_;
};

}  // namespace gmsim::engine
