// SPDX-License-Identifier: MIT
#include "engine/atomic_forces.h"

#include <algorithm>

#include "gmap/orbit_walk.h"

namespace gmsim::engine {

void AtomicForces::assign(std::span<const AtomicForce> forces, std::size_t dart_capacity) {
  first_.assign(dart_capacity + 1, 0);
  for (const AtomicForce& force : forces) ++first_[types::index(force.dart) + 1];
  for (std::size_t d = 0; d < dart_capacity; ++d) first_[d + 1] += first_[d];
  forces_.resize(forces.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (const AtomicForce& force : forces) forces_[next[types::index(force.dart)]++] = force;
}

void AtomicForces::for_each(const gmap::GMap& map, types::OrbitType orbit, gmap::DartId dart,
                            const std::function<bool(const AtomicForce&)>& visit) const {
  std::vector<gmap::DartId> darts;
  gmap::for_each_dart(map, orbit, dart, [&](gmap::DartId d) { darts.push_back(d); });
  std::sort(darts.begin(), darts.end());
  for (const gmap::DartId d : darts) {
    if (types::index(d) + 1 >= first_.size()) continue;  // younger than the forces
    for (std::uint32_t k = first_[types::index(d)]; k < first_[types::index(d) + 1]; ++k)
      if (orbit.contains(forces_[k].orbit) && !visit(forces_[k])) return;
  }
}

AtomicForces::Force AtomicForces::force_on(const gmap::GMap& map, types::OrbitType orbit,
                                           gmap::DartId dart,
                                           std::optional<types::InteractionId> only) const {
  Force sum{};
  for_each(map, orbit, dart, [&](const AtomicForce& force) {
    if (!only || *only == force.interaction)
      for (std::size_t k = 0; k < 3; ++k) sum[k] += force.force[k];
    return true;
  });
  return sum;
}

}  // namespace gmsim::engine
