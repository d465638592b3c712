// SPDX-License-Identifier: MIT
#pragma once

namespace gmsim::engine {

/// Chooses the lengths of steps from their estimated errors (proportional-integral control;
/// Gustafsson 1991, Hairer and Wanner II.4).
class StepControl {
 public:
  /// `embedded_order`: of the solution the error estimate compares with.
  explicit StepControl(int embedded_order = 0) : order_(embedded_order + 1) {}

  /// s: the step to try.
  [[nodiscard]] double next() const { return next_; }
  void set_next(double dt) { next_ = dt; }

  /// A step of length `dt` had this error norm, at most 1. `shortened`: it was cut to end at a given
  /// time, which says nothing about what longer ones would do.
  void accept(double dt, double error, bool shortened);
  /// A step of length `dt` had this error norm, above 1 or not finite.
  void reject(double dt, double error);

 private:
  int order_;
  double next_ = 0;
  double last_error_ = 1e-4;
  bool rejected_ = false;
};

/// Starting step of Hairer, Norsett and Wanner II.4: from the norms of the state (d0), of its rate
/// (d1, 1/s) and of the change of the rate over `trial` seconds, per second (d2, 1/s^2).
[[nodiscard]] double trial_first_step(double d0, double d1);
[[nodiscard]] double first_step(double trial, double d1, double d2, int order);

}  // namespace gmsim::engine
