// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "compile/dependence.h"
#include "engine/effects.h"

namespace gmsim::engine {

/// What has to be looked at again after rewrites.
struct MapDelta {
  /// Darts with another link than before, in an orbit with another row or other values or in one that
  /// was given a value; created and removed ones too. Ascending, each once.
  std::vector<compile::Dependence> darts;
  std::vector<Row> vertices;  ///< rows that hold a touched dart or one of these, or did; ascending
};

[[nodiscard]] MapDelta map_delta(const State& state, const Effects& effects);

}  // namespace gmsim::engine
