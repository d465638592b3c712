// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "compile/match_plan.h"
#include "gmap/gmap.h"

namespace gmsim::engine {

/// The links to follow, one after another.
using Way = std::vector<std::int8_t>;

/// From each dart that a pattern speaks of, unnamed ones on its paths included, the ways back to the
/// hook: where a match that holds this dart must start. The empty way (the hook itself) comes first.
[[nodiscard]] std::vector<Way> ways_to_hook(const compile::MatchPlan& plan);

[[nodiscard]] gmap::DartId follow(const gmap::GMap& map, gmap::DartId dart, const Way& way);

}  // namespace gmsim::engine
