// SPDX-License-Identifier: MIT
#include "engine/atomic_forces.h"

#include <algorithm>
#include <tuple>

#include "gmap/orbit_walk.h"
#include "support/sort_once.h"

namespace gmsim::engine {

namespace {

void add(VertexRecord& sum, const VertexRecord& force, double share) {
  sum.x += share * force.x;
  sum.y += share * force.y;
  sum.z += share * force.z;
}

}  // namespace

void AtomicForceIndex::rebuild(std::span<const AtomicForce> forces) {
  std::vector<std::uint32_t> counts(map_.dart_end(), 0);
  for (const AtomicForce& force : forces) ++counts[types::index(force.dart)];
  lists_.rebuild(counts.size(), [&](std::size_t dart) { return counts[dart]; });
  forces_.assign(forces.begin(), forces.end());
  free_.clear();
  for (std::uint32_t number = 0; number < forces_.size(); ++number)
    lists_.append(types::index(forces_[number].dart), number);
}

// ---- changes ------------------------------------------------------------------------------------

namespace {

auto place(const AtomicForce& force) { return std::tuple(force.number, force.key, force.target); }

}  // namespace

void AtomicForceIndex::update(const AtomicForceChanges& changes, std::vector<DartId>& changed) {
  lists_.grow(map_.dart_end());
  leaving_.clear();
  for (const auto& gone : changes.gone) leave(gone);
  for (const AtomicForce& force : changes.come) {
    if (come_back(force)) continue;
    insert(force);
    changed.push_back(force.dart);
  }
  for (const auto& [dart, number] : leaving_) {
    if (forces_[number].share != 0) continue;
    const std::span<const std::uint32_t> list = lists_[types::index(dart)];
    const auto at = std::find(list.begin(), list.end(), number);
    lists_.erase(types::index(dart), static_cast<std::size_t>(at - list.begin()));
    forces_[number] = AtomicForce{};
    forces_[number].share = 0;
    free_.push_back(number);
    changed.push_back(dart);
  }
}

void AtomicForceIndex::leave(const AtomicForceChanges::Gone& gone) {
  for (const std::uint32_t number : lists_[types::index(gone.dart)]) {
    AtomicForce& force = forces_[number];
    if (force.number != gone.number || force.key != gone.key || force.share == 0) continue;
    force.share = 0;
    leaving_.emplace_back(gone.dart, number);
  }
}

bool AtomicForceIndex::come_back(const AtomicForce& force) {
  for (const std::uint32_t number : lists_[types::index(force.dart)]) {
    AtomicForce& there = forces_[number];
    if (place(there) != place(force) || there.orbit != force.orbit) continue;
    there = force;
    return true;
  }
  return false;
}

void AtomicForceIndex::insert(const AtomicForce& force) {
  std::uint32_t number = static_cast<std::uint32_t>(forces_.size());
  if (free_.empty()) {
    forces_.push_back(force);
  } else {
    number = free_.back();
    free_.pop_back();
    forces_[number] = force;
  }
  const std::size_t dart = types::index(force.dart);
  const std::span<const std::uint32_t> list = lists_[dart];
  const auto after = std::find_if(list.begin(), list.end(), [&](std::uint32_t other) {
    return place(force) < place(forces_[other]);
  });
  lists_.insert(dart, static_cast<std::size_t>(after - list.begin()), number);
}

// ---- readings -----------------------------------------------------------------------------------

void AtomicForceIndex::list(types::OrbitType orbit, DartId dart,
                            std::vector<std::uint32_t>& out) const {
  darts_.clear();
  gmap::for_each_dart(map_, orbit, dart, [&](DartId d) { darts_.push_back(d); });
  std::sort(darts_.begin(), darts_.end());
  for (const DartId d : darts_)
    for (const std::uint32_t number : lists_[types::index(d)])
      if (orbit.contains(forces_[number].orbit)) out.push_back(number);
}

void AtomicForceIndex::read(std::span<const VertexRecord> slots,
                            std::vector<VertexRecord>& values) const {
  values.assign(forces_.size(), {});
  for (std::size_t k = 0; k < forces_.size(); ++k)
    if (forces_[k].share != 0) add(values[k], slots[forces_[k].slot], forces_[k].share);
}

VertexRecord AtomicForceReader::sum(types::OrbitType orbit, DartId dart,
                                    std::uint32_t only) const {
  std::vector<std::uint32_t> numbers;
  index->list(orbit, dart, numbers);
  VertexRecord sum;
  for (const std::uint32_t number : numbers) {
    const AtomicForce& force = (*index)[number];
    if (only == 0 || types::index(force.interaction) + 1 == only)
      add(sum, slots[force.slot], force.share);
  }
  return sum;
}

std::vector<VertexRecord> AtomicForceReader::list(types::OrbitType orbit, DartId dart) const {
  std::vector<std::uint32_t> numbers;
  index->list(orbit, dart, numbers);
  std::vector<VertexRecord> forces(numbers.size());
  for (std::size_t k = 0; k < numbers.size(); ++k)
    add(forces[k], slots[(*index)[numbers[k]].slot], (*index)[numbers[k]].share);
  return forces;
}

// ---- sums on orbits -----------------------------------------------------------------------------

void OrbitForces::list(const AtomicForceIndex& atomic, DartId dart) {
  numbers_.clear();
  listed_.clear();
  atomic.list(orbit_, dart, numbers_);
  for (const std::uint32_t k : numbers_)
    if (only_ == 0 || types::index(atomic[k].interaction) + 1 == only_)
      listed_.push_back({atomic[k].slot, atomic[k].share});
}

void OrbitForces::rebuild(const AtomicForceIndex& atomic, const gmap::OrbitIndex& orbits) {
  std::vector<SlotShare> all;
  std::vector<std::uint32_t> counts(orbits.row_end(), 0);
  for (gmap::Row row = 0; row < orbits.row_end(); ++row) {
    if (!orbits.alive(row)) continue;
    list(atomic, orbits.smallest(row));
    counts[row] = static_cast<std::uint32_t>(listed_.size());
    all.insert(all.end(), listed_.begin(), listed_.end());
  }
  terms_.rebuild(counts.size(), [&](std::size_t row) { return counts[row]; });
  auto next = all.begin();
  for (gmap::Row row = 0; row < counts.size(); ++row)
    for (std::uint32_t k = 0; k < counts[row]; ++k) terms_.append(row, *next++);
}

void OrbitForces::update(const AtomicForceIndex& atomic, const gmap::OrbitIndex& orbits,
                         std::span<const DartId> darts, std::span<const gmap::Row> removed) {
  terms_.grow(orbits.row_end());
  for (const gmap::Row row : removed) terms_.clear(row);
  std::vector<gmap::Row> rows;
  for (const DartId dart : darts)
    if (orbits.row(dart) != gmap::kNoRow) rows.push_back(orbits.row(dart));
  support::sort_once(rows);
  for (const gmap::Row row : rows) {
    list(atomic, orbits.smallest(row));
    terms_.clear(row);
    for (const SlotShare& term : listed_) terms_.append(row, term);
  }
}

void OrbitForces::sum(std::span<const VertexRecord> slots) {
  values_.resize(terms_.rows());
  if (values_.empty()) return;
  sum_shares(&slots.data()->x, terms_.lists(), terms_.entries(),
             static_cast<std::uint32_t>(values_.size()), &values_.front().x);
}

}  // namespace gmsim::engine
