// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "gmap/gmap.h"

namespace gmsim::gmap {

/// A random valid map: any links that satisfy the axioms, so with free darts, cells of one dart,
/// folded edges, cells sewn to themselves, several components. The same seed gives the same map.
[[nodiscard]] GMap random_map(int dimension, std::uint32_t darts, std::uint64_t seed);

}  // namespace gmsim::gmap
