// SPDX-License-Identifier: MIT
#include "engine/integrators/step_control.h"

#include <algorithm>
#include <cmath>

namespace gmsim::engine {
namespace {

constexpr double kSafety = 0.9;
constexpr double kShrink = 0.2, kGrow = 5;

}  // namespace

void StepControl::accept(double dt, double error, bool shortened) {
  const double known = std::max(error, 1e-10);
  double factor = kSafety * std::pow(known, -0.7 / order_) * std::pow(last_error_, 0.4 / order_);
  factor = std::clamp(factor, kShrink, rejected_ ? 1.0 : kGrow);
  const double wish = dt * factor;
  next_ = shortened ? std::max(wish, next_) : wish;
  last_error_ = std::max(error, 1e-4);
  rejected_ = false;
}

void StepControl::reject(double dt, double error) {
  const double factor = std::isfinite(error) ? kSafety * std::pow(error, -1.0 / order_) : kShrink;
  next_ = dt * std::clamp(factor, kShrink, kSafety);
  rejected_ = true;
}

double trial_first_step(double d0, double d1) {
  return d0 < 1e-5 || d1 < 1e-5 ? 1e-6 : 0.01 * d0 / d1;
}

double first_step(double trial, double d1, double d2, int order) {
  const double rate = std::max(d1, d2);
  const double wish =
      rate <= 1e-15 ? std::max(1e-6, trial * 1e-3) : std::pow(0.01 / rate, 1.0 / (order + 1));
  return std::min(100 * trial, wish);
}

}  // namespace gmsim::engine
