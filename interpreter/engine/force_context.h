// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "compile/specialise.h"
#include "compile/value_source.h"
#include "engine/model.h"
#include "engine/state.h"

namespace gmsim::engine {

/// What all forces of a model share: the state, the interactions at work, and where each value that
/// they read comes from. Stays where it was made: specialisers refer to it.
///
/// Parameters that are the same everywhere are constants, those of time are expressions, the others
/// columns. Derived values that cannot change while the integrator runs (a mass) are gathered, those
/// in motion computed inside the programs. Parameters of interactions that are not at work are
/// missing.
struct ForceContext {
  ForceContext(const State& of, std::vector<ActiveInteraction> interactions);
  ForceContext(const ForceContext&) = delete;
  ForceContext& operator=(const ForceContext&) = delete;

  [[nodiscard]] const compile::InteractionBody& body(std::uint32_t number) const {
    return state.program.interaction_bodies[active[number].interaction];
  }
  [[nodiscard]] const compile::RootedPattern& pattern(std::uint32_t number) const {
    return state.program.interactions[active[number].interaction];
  }
  /// Rows of Motion.
  [[nodiscard]] const gmap::OrbitIndex& vertices() const { return state.store.index_of(position); }

  const State& state;
  const std::vector<ActiveInteraction> active;  ///< loads last; a match's interaction is a number here
  const EmbeddingId position;
  const std::optional<EmbeddingId> velocity;
  const std::vector<bool> in_motion;  ///< by EmbeddingId
  const compile::ValueSources sources;
  const compile::World world;
};

}  // namespace gmsim::engine
