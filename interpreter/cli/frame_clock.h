// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace gmsim::cli {

/// The times at which something is due: every so often from the start, at times of their own, and
/// at the end. Times that follow each other within a step are met once.
class FrameClock {
 public:
  /// All in s. `every` 0: not regularly. `at` in any order.
  FrameClock(double start, double every, std::vector<double> at, double end);

  /// The earliest time that has not been passed; infinite after the end.
  [[nodiscard]] double next() const;
  /// Is something due at `time`, give or take `slack`?
  [[nodiscard]] bool is_due(double time, double slack) const { return time >= next() - slack; }
  /// Passes over everything up to `time`.
  void pass(double time, double slack);

 private:
  [[nodiscard]] double next_regular() const;

  double start_, every_, end_;
  std::int64_t passed_ = 0;       // regular times
  std::vector<double> at_;        // ascending
  std::size_t passed_at_ = 0;
  bool end_passed_ = false;
};

}  // namespace gmsim::cli
