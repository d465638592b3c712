// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "compile/match_plan.h"
#include "gmap/gmap.h"

namespace gmsim::engine {

/// The links to follow, one after another.
using Way = std::vector<std::int8_t>;

/// A dart that a pattern speaks of, be it an unnamed one on its paths.
struct PatternDart {
  Way to_hook;            ///< where a match that holds this dart must start
  types::OrbitType links; ///< those of its links on which the pattern rests
};
/// All of them, the hook first; ascending by way.
[[nodiscard]] std::vector<PatternDart> pattern_darts(const compile::MatchPlan& plan);

[[nodiscard]] gmap::DartId follow(const gmap::GMap& map, gmap::DartId dart, const Way& way);

}  // namespace gmsim::engine
