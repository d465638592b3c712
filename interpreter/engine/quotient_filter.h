// SPDX-License-Identifier: MIT
#pragma once

#include <unordered_set>
#include <vector>

#include "engine/state.h"

namespace gmsim::engine {

/// Chooses the darts of an orbit, asked one by one and ascending, that stand for the orbits of
/// another type which it meets: the quotient `outer / inner` of the language.
class QuotientFilter {
 public:
  explicit QuotientFilter(const State& state) : state_(state) {}

  /// Call before each orbit.
  void start(OrbitType outer, OrbitType inner);
  [[nodiscard]] bool keeps(DartId d);

 private:
  [[nodiscard]] bool is_new(std::uint32_t orbit);

  const State& state_;
  OrbitType inner_;
  const gmap::OrbitIndex* index_ = nullptr;  // of the inner orbits, if there is one
  bool inside_ = false;                      // the inner orbits do not reach out of the outer one
  std::vector<std::uint32_t> met_;           // else those that were met,
  std::unordered_set<std::uint32_t> many_;   // and those after many
};

}  // namespace gmsim::engine
