// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/atomic_forces.h"

namespace gmsim::engine {

/// The forces that expressions read at one moment, next to positions and velocities.
struct ForceReadings {
  types::OrbitType vertex;                 ///< carries the internal sums
  std::span<const VertexRecord> internal;  ///< of all internal forces, by row of the vertex index
  std::vector<std::unique_ptr<OrbitForces>> sums;  ///< all others
  std::vector<VertexRecord> atomic;  ///< by number in the AtomicForceIndex; empty when nobody reads them

  /// Is this the sum that a force field keeps anyway? `only` as in OrbitForces.
  [[nodiscard]] bool is_internal(types::OrbitType orbit, std::uint32_t only) const {
    return only == 0 && orbit == vertex;
  }
  [[nodiscard]] bool has(types::OrbitType orbit, std::uint32_t only) const {
    return is_internal(orbit, only) || find(orbit, only) != nullptr;
  }
  /// By row of the index of the orbits.
  [[nodiscard]] std::span<const VertexRecord> values(types::OrbitType orbit,
                                                     std::uint32_t only) const {
    return is_internal(orbit, only) ? internal : find(orbit, only)->values();
  }

 private:
  [[nodiscard]] const OrbitForces* find(types::OrbitType orbit, std::uint32_t only) const {
    for (const auto& sum : sums)
      if (sum->orbit() == orbit && sum->only() == only) return sum.get();
    return nullptr;
  }
};

}  // namespace gmsim::engine
