// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "compile/program.h"
#include "gmap/embedding_store.h"
#include "gmap/gmap.h"

namespace gmsim::engine {

using gmap::DartId;
using gmap::Row;
using types::EmbeddingId;
using types::OrbitType;
using types::Slot;

/// The object that rules read and rewrite: a map, the values on its orbits, and the clock.
/// Stays where it was made, because the store refers to the map.
struct State {
  State(const compile::Program& compiled, gmap::GMap initial);
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  /// Makes a column for every stored embedding of the schema with role Data. Values without a
  /// default stay missing until they are set.
  void use_data();
  /// Makes a column for one embedding (and what else reads of it need); nothing if it has one.
  void use(EmbeddingId id) { store.use(id); }

  const compile::Program& program;
  gmap::GMap map;
  gmap::EmbeddingStore store;
  std::uint64_t seed = 0;  ///< of the scene; enters every random()
  double time = 0;         ///< s
  double dt = 0;           ///< s, length of the current step
  std::uint64_t step = 0;  ///< steps completed
};

}  // namespace gmsim::engine
