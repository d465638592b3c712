// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "gmap/embedding_store.h"
#include "gmap/gmap.h"

namespace gmsim::gmap {

/// Every broken axiom of the map (theory 1.1), at most `limit`: alpha_i not an involution, a link
/// to a dead dart, alpha_i alpha_j no involution for i + 2 <= j. Empty when the map is valid.
[[nodiscard]] std::vector<std::string> validate(const GMap& map, std::size_t limit = 10);

/// As above, and: every orbit index in use has exactly one row per orbit and every dart of the
/// orbit finds it; every non-optional column has a value for every orbit.
[[nodiscard]] std::vector<std::string> validate(const GMap& map, const EmbeddingStore& store,
                                                std::size_t limit = 10);

}  // namespace gmsim::gmap
