// SPDX-License-Identifier: MIT
#include "compile/walked_orbits.h"

#include <algorithm>

#include "gmap/orbit_walk.h"

namespace gmsim::compile {

void WalkedOrbits::start(std::span<const DartId> darts) {
  darts_.clear();
  used_ = 0;
  if (++epoch_ == 0) {
    slots_.assign(slots_.size(), {});
    epoch_ = 1;
  }
  for (const DartId dart : darts) add(dart);
}

WalkedOrbits::Slot& WalkedOrbits::find(std::uint32_t type, DartId dart) {
  const std::uint64_t key = (std::uint64_t{types::index(dart)} << 4 | type) * 0x9e3779b97f4a7c15u;
  std::size_t i = (key >> 32) & (slots_.size() - 1);
  while (slots_[i].epoch == epoch_ && (slots_[i].dart != dart || slots_[i].type != type))
    i = (i + 1) & (slots_.size() - 1);
  return slots_[i];
}

void WalkedOrbits::grow() {
  std::vector<Slot> old(2 * slots_.size());
  old.swap(slots_);
  for (const Slot& slot : old)
    if (slot.epoch == epoch_) find(slot.type, slot.dart) = slot;
}

DartId WalkedOrbits::smallest(OrbitType type, DartId dart) {
  if (const Slot& known = find(type.bits(), dart); known.epoch == epoch_) return known.smallest;
  orbit_.clear();
  gmap::for_each_dart(map_, type, dart, [&](DartId d) { orbit_.push_back(d); });
  const DartId first = *std::min_element(orbit_.begin(), orbit_.end());
  for (const DartId d : orbit_) {
    darts_.push_back({d, kEverything});
    if (2 * ++used_ > slots_.size()) grow();
    find(type.bits(), d) = {epoch_, type.bits(), d, first};
  }
  return first;
}

std::vector<DartId> WalkedOrbits::quotient(OrbitType outer, OrbitType inner, DartId dart) {
  smallest(outer, dart);
  return gmap::quotient(map_, outer, dart, [&](DartId d) { return smallest(inner, d); });
}

}  // namespace gmsim::compile
