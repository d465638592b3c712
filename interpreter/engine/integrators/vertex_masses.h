// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/state.h"
#include "support/diagnostic.h"

namespace gmsim::engine {

/// kg by row of the vertex index, dead rows 0; read from the embedding `mass`. Empty after a
/// failure, which is then in `problem`.
[[nodiscard]] std::vector<double> vertex_masses(const State& state,
                                                std::optional<support::Diagnostic>& problem);

/// 1/kg by row: 0 for dead rows and where `held` (the row is fixed or prescribed).
/// A free vertex without a usable mass is a problem.
[[nodiscard]] std::vector<double> inverse_masses(const State& state,
                                                 const std::vector<double>& masses,
                                                 const std::vector<bool>& held,
                                                 std::optional<support::Diagnostic>& problem);

/// "vertex (0.1, 0.2, 0), dart 12", with the position that the store has.
[[nodiscard]] std::string vertex_text(const State& state, DartId dart);

}  // namespace gmsim::engine
