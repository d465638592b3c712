// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
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
  /// Is the vertex of this row moved?
  [[nodiscard]] bool moves(gmap::Row row) const {
    return row < driver_of_row_.size() && driver_of_row_[row] != 0;
  }
  /// The length of a usual step: derivatives are taken over a part of it.
  void set_step(double dt) { step_ = dt; }

  /// Looks vertices up anew after the map has changed: all parts of a vertex move on. `changed`: rows
  /// that hold a dart with a changed link, or did. True when one of them is moved, or was.
  bool follow(const State& state, std::span<const gmap::Row> changed);
  void begin_step(const PhasePoint& now);
  /// Positions and velocities at `time`. False after a failure.
  bool apply(double time, Motion& motion);
  [[nodiscard]] const std::optional<support::Diagnostic>& error() const { return error_; }

 private:
  struct Driver {
    std::vector<gmap::Row> rows;  // ascending
    bool gives_position = false;
    ClockExpression function;
    std::vector<VertexRecord> from = {};  // where the step began, by row; when velocity is given
    double from_time = 0;
    // What the function gave last; stages of a step often share a time.
    double time = std::numeric_limits<double>::quiet_NaN();
    std::array<double, 3> moved = {};     // position, or the way since the step began
    std::array<double, 3> velocity = {};
  };
  /// 1 + number of the driver of a dart's vertex, 0 for none.
  [[nodiscard]] std::uint32_t driver_at(const State& state, DartId dart) const;
  void add(const State& state, std::span<const DartId> vertices, bool gives_position,
           ClockExpression function);
  bool evaluate(Driver& driver, double time);
  bool integrate(Driver& driver, double time);

  std::vector<Driver> drivers_;
  // 1 + number of the driver, or 0: by dart of those that were there at first, by row now.
  std::vector<std::uint32_t> driver_of_dart_, driver_of_row_;
  double step_ = 1e-3;  // s
  std::optional<support::Diagnostic> error_;
};

}  // namespace gmsim::engine
