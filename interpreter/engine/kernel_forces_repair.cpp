// SPDX-License-Identifier: MIT
// KernelForces: repairs where links have changed. Only matches that depend on a changed dart are
// looked at again, so the cost does not depend on the size of the mesh; tables, merged groups and the
// order of sums come out as if they had been made anew.
#include <algorithm>
#include <optional>

#include "engine/kernel_forces.h"
#include "gmap/orbit_walk.h"
#include "support/sort_once.h"

namespace gmsim::engine {

bool KernelForces::repair(std::span<const DartId> changed) {
  for (const auto& of : interactions_)
    if (!of->repairable()) return false;
  changes_.gone.clear();
  placed_.clear();
  each_pass([&](ForcePass& pass) { pass.grow(context_.vertices().row_end()); });
  for (const auto& of : interactions_) {
    repair(*of, changed);
    if (error_) return true;
  }
  each_pass([&](const ForcePass& pass) { stale_ = stale_ || pass.crowded(); });
  if (stale_) {
    for (const auto& of : interactions_) of->pack();
    lay_out();
  } else {
    list_placed();
  }
  return true;
}

// ---- one interaction ----------------------------------------------------------------------------

void KernelForces::repair(InteractionTables& of, std::span<const DartId> changed) {
  std::vector<DartId> keys, hooks;
  of.watch().find_stale(changed, keys, hooks);
  Repair repair{&of, std::vector<std::vector<DartId>>(of.shape_count())};
  for (const DartId key : keys) {
    hooks.push_back(key);  // there may be a match where a condition stood against it
    if (of.place(key).shape == InteractionTables::kNowhere) continue;
    hooks.push_back(of.hook(of.place(key)));
    take_out(repair, key);
  }
  find_again(repair, hooks);
  merge_again(repair);
}

void KernelForces::find_again(Repair& repair, std::vector<DartId>& hooks) {
  InteractionTables& of = *repair.of;
  const gmap::GMap& map = context_.state.map;
  for (DartId& hook : hooks)
    hook = map.alive(hook) ? gmap::smallest_dart(map, of.body().orbit, hook) : gmap::kNoDart;
  support::sort_once(hooks);
  if (!hooks.empty() && hooks.back() == gmap::kNoDart) hooks.pop_back();
  found_again_ += hooks.size();
  for (const DartId smallest : hooks) {
    if (of.place(smallest).shape != InteractionTables::kNowhere) take_out(repair, smallest);
    std::optional<DartId> key;
    if ((error_ = of.find_at(smallest, key))) return;
    if (of.shape_count() > repair.regroup.size()) stale_ = true;  // a table without a block
    if (key) put_in(repair, *key);
  }
}

void KernelForces::take_out(Repair& repair, DartId key) {
  InteractionTables& of = *repair.of;
  const InteractionTables::Place place = of.place(key);
  if (!stale_) {
    const MergedTable* merged = of.merged(place.shape);
    if (merged != nullptr)
      if (const std::uint32_t group = merged->group_of(key); group != gmap::kNoRow)
        dissolve(repair, place.shape, group);
    each_pass([&](ForcePass& pass) {
      if (!pass.merges(of, place.shape)) pass.unlink(of, place.shape, place.row);
    });
    note_gone(of, place);
  }
  of.remove(key);
}

void KernelForces::put_in(Repair& repair, DartId key) {
  if (stale_) return;
  InteractionTables& of = *repair.of;
  const InteractionTables::Place place = of.place(key);
  each_pass([&](ForcePass& pass) {
    if (!pass.merges(of, place.shape)) pass.link(of, place.shape, place.row);
  });
  const MergedTable* merged = of.merged(place.shape);
  note_placed(of, key);
  if (merged == nullptr) return;
  const MatchTable& table = of.table(place.shape);
  const auto& ends = merged->plan().ends;
  dissolve_between(repair, place.shape,
                   {table.rows(ends[0])[place.row], table.rows(ends[1])[place.row]});
  repair.regroup[place.shape].push_back(key);
}

// ---- merged matches -----------------------------------------------------------------------------

void KernelForces::dissolve(Repair& repair, std::uint32_t shape, std::uint32_t group) {
  InteractionTables& of = *repair.of;
  MergedTable& merged = *of.merged(shape);
  std::vector<DartId>& keys = repair.regroup[shape];
  const std::size_t before = keys.size();
  merged.members(group, keys);
  each_pass([&](ForcePass& pass) {
    if (pass.merges(of, shape)) pass.unlink(of, shape, group);
  });
  if (atomic_ && atomic_->merges(of, shape))  // their forces will be kept elsewhere
    for (std::size_t k = before; k < keys.size(); ++k) {
      note_gone(of, of.place(keys[k]));
      note_placed(of, keys[k]);
    }
  merged.remove(group);
}

/// All groups between two vertices, in whatever direction.
void KernelForces::dissolve_between(Repair& repair, std::uint32_t shape, std::array<Row, 2> ends) {
  const InteractionTables& of = *repair.of;
  const MatchTable& groups = of.merged(shape)->table();
  between_.clear();
  for (const ForceOrder order : main_.sums().orders(ends[0])) {
    const DartId key = key_of(order);
    if (interaction_of(order) != of.number() || of.place(key).shape != shape) continue;
    const std::uint32_t group = of.merged(shape)->group_of(key);
    const Row a = groups.rows(0)[group], b = groups.rows(1)[group];
    const bool is_between = (a == ends[0] && b == ends[1]) || (a == ends[1] && b == ends[0]);
    // A spring from a vertex to itself is listed there with both its ends.
    if (is_between && (between_.empty() || between_.back() != group)) between_.push_back(group);
  }
  for (const std::uint32_t group : between_) dissolve(repair, shape, group);
}

void KernelForces::merge_again(Repair& repair) {
  InteractionTables& of = *repair.of;
  for (std::uint32_t shape = 0; shape < repair.regroup.size() && !stale_; ++shape) {
    std::vector<DartId>& keys = repair.regroup[shape];
    support::sort_once(keys);
    std::vector<std::uint32_t> rows;
    for (const DartId key : keys)  // those that are still there, with this shape
      if (of.place(key).shape == shape) rows.push_back(of.place(key).row);
    if (rows.empty()) continue;
    MergedTable& merged = *of.merged(shape);
    const std::uint32_t before = merged.table().size();
    merged.group(of.table(shape), context_.state.store, rows);
    each_pass([&](ForcePass& pass) {
      if (!pass.merges(of, shape)) return;
      for (std::uint32_t row = before; row < merged.table().size(); ++row)
        pass.link(of, shape, row);
    });
  }
}

}  // namespace gmsim::engine
