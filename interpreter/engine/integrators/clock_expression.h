// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_set>

#include "engine/model.h"
#include "engine/tree_eval.h"

namespace gmsim::engine {

/// A vec3 as a function of time at one dart. Whatever does not depend on the clock is evaluated when
/// the function is made, so `position` in a prescribed motion is where the vertex was then and not
/// what the motion makes of it.
class ClockExpression {
 public:
  /// Failures are in `error()`.
  ClockExpression(State& state, const DartExpression& expression, DartId dart);

  /// The value at `time`; empty after a failure.
  [[nodiscard]] std::optional<std::array<double, 3>> at(double time);
  /// The derivative at `time`, by central differences of order 6 with points `distance` apart.
  [[nodiscard]] std::optional<std::array<double, 3>> rate(double time, double distance);
  [[nodiscard]] const std::optional<support::Diagnostic>& error() const { return error_; }

 private:
  State* state_;
  types::ExprPtr residue_;  // what is left to evaluate
  Frame frame_;
  std::optional<support::Diagnostic> error_;
};

/// The expression does not speak of its dart: it has one value for all vertices.
[[nodiscard]] bool same_everywhere(const DartExpression& expression);

}  // namespace gmsim::engine
