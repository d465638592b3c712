// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/atomic_forces.h"

namespace gmsim::engine {

/// The forces that expressions read at one moment, next to positions and velocities.
struct ForceReadings {
  std::vector<std::unique_ptr<OrbitForces>> sums;
  std::vector<VertexRecord> atomic;  ///< by number in the AtomicForceIndex; empty when nobody reads them

  [[nodiscard]] OrbitForces* find(types::OrbitType orbit, std::uint32_t only) const {
    for (const auto& sum : sums)
      if (sum->orbit() == orbit && sum->only() == only) return sum.get();
    return nullptr;
  }
};

}  // namespace gmsim::engine
