// SPDX-License-Identifier: MIT
// KernelForces: repairs where links have changed. Only matches that depend on a changed dart are
// looked at again, so the cost does not depend on the size of the mesh; tables, merged groups and the
// order of sums come out as if they had been made anew.
#include <algorithm>
#include <optional>

#include "engine/kernel_forces.h"
#include "support/sort_once.h"

namespace gmsim::engine {

bool KernelForces::repair(std::span<const compile::Dependence> changed) {
  for (const auto& of : interactions_)
    if (!of->matches().repairable()) return false;
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

void KernelForces::Repair::begin(InteractionTables& interaction) {
  of = &interaction;
  for (auto* lists : {&moved, &regroup}) {
    lists->resize(interaction.shape_count());
    for (auto& list : *lists) list.clear();
  }
}

void KernelForces::repair(InteractionTables& of, std::span<const compile::Dependence> changed) {
  Repair& repair = repair_;
  repair.begin(of);
  of.matches().find_stale(changed, repair.stale);
  found_again_ += repair.stale.matches.size();
  for (const StaleMatch& stale : repair.stale.matches) {
    look_at(repair, stale);
    if (error_) return;
  }
  move_groups(repair);
  find_again(repair);
  merge_again(repair);
}

void KernelForces::look_at(Repair& repair, const StaleMatch& stale) {
  MatchSet& matches = repair.of->matches();
  const MatchSet::Place place = matches.place(stale.key);
  if (place.shape == MatchSet::kNowhere) {
    // There may be a match where a condition stood against it.
    repair.stale.hooks.push_back(stale.key);
    return;
  }
  if ((error_ = matches.read_again(place, stale.what, reading_))) return;
  if (reading_.again || !follow(repair, stale.key)) take_out(repair, stale.key);
}

bool KernelForces::follow(Repair& repair, DartId key) {
  InteractionTables& of = *repair.of;
  const InteractionTables::Place place = of.place(key);
  const std::uint32_t shape = place.shape;
  if (reading_.moved.empty() && !reading_.own_changed) return true;
  bool fits = true;
  each_pass([&](const ForcePass& pass) {
    for (const auto& [role, from, to] : reading_.moved)
      fits = fits && (stale_ || pass.merges(of, shape) ||
                      pass.can_move(of, shape, place.row, from, to));
  });
  if (!fits) return false;
  of.matches().adopt(place, reading_);
  if (stale_) return true;
  each_pass([&](ForcePass& pass) {
    if (pass.merges(of, shape)) return;
    for (const auto& [role, from, to] : reading_.moved)
      pass.move(of, shape, place.row, role, from, to);
    pass.rerun(of, shape, place.row);
  });
  const MergedTable* merged = of.merged(shape);
  if (merged == nullptr) return true;
  const auto& ends = merged->plan().ends;
  const bool between_others =
      std::all_of(reading_.moved.begin(), reading_.moved.end(), [&](const auto& moved) {
        return moved.role == ends[0] || moved.role == ends[1];
      });
  if (reading_.own_changed || !between_others) {
    if (const std::uint32_t group = merged->group_of(key); group != gmap::kNoRow)
      dissolve(repair, shape, group);
  } else {
    repair.moved[shape].push_back(key);
  }
  return true;
}

void KernelForces::find_again(Repair& repair) {
  InteractionTables& of = *repair.of;
  std::vector<DartId>& hooks = repair.stale.hooks;
  of.matches().list_orbits(repair.stale);
  found_again_ += hooks.size();
  // take_out() gives more darts, of orbits that are looked at here anyway.
  for (std::size_t k = 0, count = hooks.size(); k < count; ++k) {
    const DartId smallest = hooks[k];
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
  of.matches().remove(key, repair.stale.hooks);
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

/// A group stays one where all its matches have gone to the same vertices.
bool KernelForces::move_group(const InteractionTables& of, MergedTable& merged,
                              std::uint32_t shape, std::uint32_t group) {
  const MatchTable& table = of.table(shape);
  const auto ends_of = [&](DartId key) {
    const std::uint32_t row = of.place(key).row;
    return std::array{table.rows(merged.plan().ends[0])[row], table.rows(merged.plan().ends[1])[row]};
  };
  members_.clear();
  merged.members(group, members_);
  const std::array<Row, 2> before{merged.table().rows(0)[group], merged.table().rows(1)[group]};
  const std::array<Row, 2> ends = ends_of(members_.front());
  for (const DartId key : members_) {
    const std::array<Row, 2> other = ends_of(key);
    const bool turned = merged.plan().symmetric && other[0] == ends[1] && other[1] == ends[0];
    if (other != ends && !turned) return false;
  }
  if (ends == before) return true;
  bool fits = true;
  const auto each_end = [&](const auto& change) {
    for (std::uint32_t k = 0; k < 2; ++k)
      if (before[k] != ends[k]) change(k);
  };
  each_pass([&](const ForcePass& pass) {
    if (!pass.merges(of, shape)) return;
    each_end([&](std::uint32_t k) {
      fits = fits && pass.can_move(of, shape, group, before[k], ends[k]);
    });
  });
  if (!fits) return false;
  each_pass([&](ForcePass& pass) {
    if (pass.merges(of, shape))
      each_end([&](std::uint32_t k) { pass.move(of, shape, group, k, before[k], ends[k]); });
  });
  merged.set_ends(group, ends);
  each_pass([&](ForcePass& pass) {
    if (pass.merges(of, shape)) pass.rerun(of, shape, group);
  });
  return true;
}

void KernelForces::move_groups(Repair& repair) {
  InteractionTables& of = *repair.of;
  for (std::uint32_t shape = 0; shape < repair.moved.size() && !stale_; ++shape) {
    for (const DartId key : repair.moved[shape]) {
      MergedTable& merged = *of.merged(shape);
      const std::uint32_t group = merged.group_of(key);
      if (group == gmap::kNoRow || move_group(of, merged, shape, group)) continue;
      dissolve(repair, shape, group);
      const auto& ends = merged.plan().ends;
      const MatchTable& table = of.table(shape);
      for (const DartId member : std::vector<DartId>(members_)) {
        const std::uint32_t row = of.place(member).row;
        dissolve_between(repair, shape, {table.rows(ends[0])[row], table.rows(ends[1])[row]});
      }
    }
  }
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
