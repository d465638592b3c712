// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <unordered_set>

#include "engine/state.h"

namespace gmsim::engine {

/// Chooses the darts of an orbit, asked one by one and ascending, that stand for the orbits of
/// another type which it meets: the quotient `outer / inner` of the language.
class QuotientFilter {
 public:
  explicit QuotientFilter(const State& state) : state_(state) {}

  /// Call before each orbit.
  void start(OrbitType outer, OrbitType inner);
  /// Inside, the smallest dart of an inner orbit is the first that is asked. An orbit that reaches
  /// out is known by its number: two darts fall together when they share the whole of it, though
  /// the way from one to the other may leave the outer orbit.
  [[nodiscard]] bool keeps(DartId d) {
    if (index_ == nullptr) return keeps_unnumbered(d);
    const Row row = index_->row(d);
    return inside_ ? index_->smallest(row) == d : is_new(row);
  }

 private:
  static constexpr std::size_t kFew = 64;  // among which a search goes from one to the next
  [[nodiscard]] bool keeps_unnumbered(DartId d);
  [[nodiscard]] bool is_new(std::uint32_t orbit) {
    for (std::size_t k = 0; k < count_; ++k) {
      if (met_[k] == orbit) return false;
    }
    if (count_ == kFew) return many_.insert(orbit).second;
    met_[count_++] = orbit;
    return true;
  }

  const State& state_;
  OrbitType inner_;
  const gmap::OrbitIndex* index_ = nullptr;  // of the inner orbits, if there is one
  bool inside_ = false;                      // the inner orbits do not reach out of the outer one
  std::array<std::uint32_t, kFew> met_{};    // else those that were met,
  std::size_t count_ = 0;
  std::unordered_set<std::uint32_t> many_;  // and those after many
};

}  // namespace gmsim::engine
