// SPDX-License-Identifier: MIT
#include "engine/atomic_forces.h"

#include <algorithm>

#include "gmap/orbit_walk.h"

namespace gmsim::engine {

namespace {

void add(VertexRecord& sum, const VertexRecord& force, double share) {
  sum.x += share * force.x;
  sum.y += share * force.y;
  sum.z += share * force.z;
}

}  // namespace

void AtomicForceIndex::rebuild(std::span<const AtomicForce> forces) {
  const std::size_t darts = map_.dart_end();
  first_.assign(darts + 1, 0);
  for (const AtomicForce& force : forces) ++first_[types::index(force.dart) + 1];
  for (std::size_t d = 0; d < darts; ++d) first_[d + 1] += first_[d];
  forces_.resize(forces.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (const AtomicForce& force : forces) forces_[next[types::index(force.dart)]++] = force;
}

void AtomicForceIndex::list(types::OrbitType orbit, DartId dart,
                            std::vector<std::uint32_t>& out) const {
  std::vector<DartId> darts;
  gmap::for_each_dart(map_, orbit, dart, [&](DartId d) { darts.push_back(d); });
  std::sort(darts.begin(), darts.end());
  for (const DartId d : darts)
    for (std::uint32_t k = first_[types::index(d)]; k < first_[types::index(d) + 1]; ++k)
      if (orbit.contains(forces_[k].orbit)) out.push_back(k);
}

void AtomicForceIndex::read(std::span<const VertexRecord> slots,
                            std::vector<VertexRecord>& values) const {
  values.assign(forces_.size(), {});
  for (std::size_t k = 0; k < forces_.size(); ++k)
    add(values[k], slots[forces_[k].slot], forces_[k].share);
}

void OrbitForces::rebuild(const AtomicForceIndex& atomic, const gmap::OrbitIndex& orbits) {
  terms_.clear();
  first_.assign(orbits.row_end() + std::size_t{1}, 0);
  std::vector<std::uint32_t> numbers;
  for (gmap::Row row = 0; row < orbits.row_end(); ++row) {
    first_[row] = static_cast<std::uint32_t>(terms_.size());
    if (!orbits.alive(row)) continue;
    numbers.clear();
    atomic.list(orbit_, orbits.smallest(row), numbers);
    for (const std::uint32_t k : numbers)
      if (only_ == 0 || types::index(atomic[k].interaction) + 1 == only_)
        terms_.push_back({atomic[k].slot, atomic[k].share});
  }
  first_[orbits.row_end()] = static_cast<std::uint32_t>(terms_.size());
}

void OrbitForces::sum(std::span<const VertexRecord> slots) {
  values_.assign(first_.size() - 1, {});
  for (std::size_t row = 0; row < values_.size(); ++row)
    for (std::uint32_t k = first_[row]; k < first_[row + 1]; ++k)
      add(values_[row], slots[terms_[k].slot], terms_[k].share);
}

}  // namespace gmsim::engine
