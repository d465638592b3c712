// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/state.h"

namespace gmsim::engine {

/// The largest step that is stable here and now, and where it comes from. Infinite steps: nothing
/// limits it.
struct StabilityLimit {
  double dt = 0;              ///< s, of the integrator in use, from the element-wise bound
  double dt_global = 0;       ///< s, from the global estimate (Lanczos), >= dt
  double omega_bound = 0;     ///< rad/s
  double omega_global = 0;    ///< rad/s
  double damping_ratio = 0;   ///< of the top mode
  DartId where = gmap::kNoDart;   ///< a dart of the match that rules the bound
  std::uint32_t interaction = 0;  ///< and its interaction, as the program numbers them
};

}  // namespace gmsim::engine
