// SPDX-License-Identifier: MIT
#include "engine/quotient_filter.h"

#include <algorithm>

#include "gmap/orbit_walk.h"

namespace gmsim::engine {

void QuotientFilter::start(OrbitType outer, OrbitType inner) {
  inner_ = inner;
  index_ = state_.store.find_index(inner);
  inside_ = outer.contains(inner);
  met_.clear();
  if (!many_.empty()) many_.clear();
}

/// Inside, the smallest dart of an inner orbit is the first that is asked. An orbit that reaches out is
/// known by its number: two darts fall together when they share the whole of it, though the way from
/// one to the other may leave the outer orbit.
bool QuotientFilter::keeps(DartId d) {
  if (index_ != nullptr) {
    const Row row = index_->row(d);
    return inside_ ? index_->smallest(row) == d : is_new(row);
  }
  const DartId smallest = gmap::smallest_dart(state_.map, inner_, d);
  return inside_ ? smallest == d : is_new(types::index(smallest));
}

bool QuotientFilter::is_new(std::uint32_t orbit) {
  constexpr std::size_t kFew = 64;  // among which a search goes from one to the next
  if (std::find(met_.begin(), met_.end(), orbit) != met_.end()) return false;
  if (met_.size() == kFew) return many_.insert(orbit).second;
  met_.push_back(orbit);
  return true;
}

}  // namespace gmsim::engine
