// SPDX-License-Identifier: MIT
#include "cli/frame_clock.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace gmsim::cli {

constexpr double kNever = std::numeric_limits<double>::infinity();

FrameClock::FrameClock(double start, double every, std::vector<double> at, double end)
    : start_(start), every_(every), end_(end), at_(std::move(at)) {
  std::erase_if(at_, [&](double time) { return time < start || time > end; });
  std::sort(at_.begin(), at_.end());
}

double FrameClock::next_regular() const {
  if (every_ <= 0) return kNever;
  const double time = start_ + static_cast<double>(passed_) * every_;
  return time <= end_ ? time : kNever;
}

double FrameClock::next() const {
  double time = std::min(next_regular(), end_passed_ ? kNever : end_);
  if (passed_at_ < at_.size()) time = std::min(time, at_[passed_at_]);
  return time;
}

void FrameClock::pass(double time, double slack) {
  while (next_regular() <= time + slack) ++passed_;
  while (passed_at_ < at_.size() && at_[passed_at_] <= time + slack) ++passed_at_;
  if (end_ <= time + slack) end_passed_ = true;
}

}  // namespace gmsim::cli
