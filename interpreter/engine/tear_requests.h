// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/tear_model.h"

namespace gmsim::engine {

/// A criterion that held at a match.
struct TearRequest {
  std::uint32_t pairing = 0;     ///< of the model
  DartId hook = gmap::kNoDart;   ///< dart of the match
  std::uint32_t node = 0;        ///< of the criterion's pattern: where the change is applied
  double value = 0;
  double threshold = 0;
  std::vector<double> results;   ///< of the criterion, one after another
  std::vector<DartId> orbit;     ///< all darts of the orbit that was judged, ascending

  [[nodiscard]] double ratio() const { return value / threshold; }
};

/// A change that was applied because a criterion held: a row of the event table.
struct TearEvent {
  std::uint64_t step = 0;          ///< steps completed
  double time = 0;                 ///< s
  std::uint32_t pairing = 0;       ///< of the model
  double value = 0, threshold = 0;
  DartId dart = gmap::kNoDart;     ///< where the change was applied
  std::array<double, 3> position{};  ///< of its vertex, m
  std::uint32_t split = 0, created = 0, removed = 0;  ///< vertices
};

/// The match of a pairing that was nearest to tearing in all judgements so far.
struct NearestMatch {
  double value = 0, threshold = 0;
  double time = 0;                   ///< s
  DartId where = gmap::kNoDart;      ///< its hook; none when there never was a match
  std::array<double, 3> position{};  ///< of that dart's vertex, m
};

/// Values this close, relative to the larger, are equal: what they belong to goes together, however
/// the last bits fell.
inline constexpr double kTie = 1e-9;

/// The requests of one pairing that are applied: the strongest `at_most` of them and whatever ties
/// with the last of those; all without `at_most`. Strongest first, ties by ascending hook.
void choose_strongest(std::vector<TearRequest>& requests, std::optional<std::uint32_t> at_most);

/// All requests of a step in the order of their application: decreasing value over threshold, ties by
/// ascending dart, then by pairing.
void order_requests(std::vector<TearRequest>& requests);

}  // namespace gmsim::engine
