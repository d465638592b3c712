// SPDX-License-Identifier: MIT
#include "engine/quotient_filter.h"

#include "gmap/orbit_walk.h"

namespace gmsim::engine {

void QuotientFilter::start(OrbitType outer, OrbitType inner) {
  inner_ = inner;
  index_ = state_.store.find_index(inner);
  inside_ = outer.contains(inner);
  count_ = 0;
  if (!many_.empty()) many_.clear();
}

bool QuotientFilter::keeps_unnumbered(DartId d) {
  if (inside_ && inner_.is_single()) return state_.map.alpha(inner_.first(), d) >= d;
  const DartId smallest = gmap::smallest_dart(state_.map, inner_, d);
  return inside_ ? smallest == d : is_new(types::index(smallest));
}

}  // namespace gmsim::engine
