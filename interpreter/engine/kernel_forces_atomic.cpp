// SPDX-License-Identifier: MIT
#include <algorithm>

#include "engine/atomic_forces.h"
#include "engine/kernel_forces.h"
#include "support/sort_once.h"

namespace gmsim::engine {

void KernelForces::note_gone(const InteractionTables& of, InteractionTables::Place place) {
  if (!atomic_ || of.body().external) return;
  const MatchTable& table = of.table(place.shape);
  for (const DartId dart : table.targets(place.row))
    changes_.gone.push_back({dart, of.number(), table.key(place.row)});
}

void KernelForces::note_placed(const InteractionTables& of, DartId key) {
  if (atomic_ && !of.body().external) placed_.emplace_back(of.number(), key);
}

void KernelForces::list_placed() {
  changes_.come.clear();
  support::sort_once(placed_);
  for (const auto& [number, key] : placed_) {
    const InteractionTables& of = *interactions_[number];
    if (of.place(key).shape != InteractionTables::kNowhere)
      list_match(of, of.place(key), changes_.come);
  }
}

void KernelForces::list_atomic(std::vector<AtomicForce>& out) const {
  if (!atomic_) return;
  for (const auto& of : interactions_) {
    if (of->body().external) continue;
    of->in_order([&](std::uint32_t shape, std::uint32_t row) { list_match(*of, {shape, row}, out); });
  }
}

void KernelForces::list_match(const InteractionTables& of, InteractionTables::Place place,
                              std::vector<AtomicForce>& out) const {
  const MatchTable& table = of.table(place.shape);
  const std::span<const DartId> darts = table.targets(place.row);
  const auto& targets = of.shape(place.shape).targets;
  for (std::uint32_t t = 0; t < targets.size(); ++t) {
    // Targets that are one root's share its force.
    const auto sharing = std::count_if(targets.begin(), targets.end(), [&](const auto& other) {
      return other.root == targets[t].root;
    });
    const auto [slot, of_slot] = kept_force(of, place, targets[t].root);
    const double share = of_slot / static_cast<double>(sharing);
    out.push_back({darts[t], targets[t].orbit, of.body().id, number_of(slot),
                   is_negative(slot) ? -share : share, of.number(), table.key(place.row), t});
  }
}

std::pair<SignedSlot, double> KernelForces::kept_force(const InteractionTables& of,
                                                       InteractionTables::Place place,
                                                       std::uint32_t force) const {
  if (!atomic_->merges(of, place.shape))
    return {atomic_->slot(of, place.shape, force, place.row), 1.0};
  const MergedTable& merged = *of.merged(place.shape);
  const MatchTable& table = of.table(place.shape);
  const auto& ends = merged.plan().ends;
  const std::uint32_t group = merged.group_of(table.key(place.row));
  const auto [of_group, share] = merged.share(
      group, force, {table.rows(ends[0])[place.row], table.rows(ends[1])[place.row]});
  return {atomic_->slot(of, place.shape, of_group, group), share};
}

}  // namespace gmsim::engine
