// SPDX-License-Identifier: MIT
#include "compile/role_table.h"

#include "gmap/orbit_walk.h"

namespace gmsim::compile {

void RoleTable::clear() {
  roles_.clear();
  if (++epoch_ != 0) return;
  for (auto& stamps : stamps_) stamps.clear();
  epoch_ = 1;
}

std::uint32_t RoleTable::role(OrbitType type, DartId dart) {
  const gmap::OrbitIndex* index = world_.store.find_index(type);
  const Row row = index != nullptr ? index->row(dart) : gmap::kNoRow;
  const std::uint32_t identity =
      index != nullptr ? row : types::index(gmap::smallest_dart(world_.map, type, dart));
  std::vector<Stamp>& stamps = stamps_[type.bits()];
  if (stamps.size() <= identity) stamps.resize(std::size_t{identity} + 1);
  Stamp& stamp = stamps[identity];
  if (stamp.epoch != epoch_) {
    stamp = {epoch_, static_cast<std::uint32_t>(roles_.size())};
    roles_.push_back({type, dart, row});
  }
  return stamp.role;
}

}  // namespace gmsim::compile
