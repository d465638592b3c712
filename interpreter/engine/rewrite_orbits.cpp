// SPDX-License-Identifier: MIT
// Rewriter: the orbits that a rule changes. Where the plan says what becomes of them, the map is not
// walked: created darts enter orbits that stay as they are, or orbits are listed from the match. Rows,
// effects and their order are those that a repair alone would give.
#include <algorithm>

#include "engine/rewriter_implementation.h"
#include "support/sort_once.h"

namespace gmsim::engine {

using compile::ColumnChange;
using compile::NodeFate;
using compile::OrbitClasses;
using gmap::OrbitChange;
using gmap::OrbitIndex;
using gmap::OrbitRepair;

void Rewriter::Implementation::repair_orbits(const compile::RewritePlan& plan) {
  if (plan.changes.empty()) return;
  for (const auto& entry : state.store.indices()) {
    OrbitIndex& index = *entry;
    const OrbitClasses* classes = plan.find_orbits(index.type());
    if (classes != nullptr ? classes->classes.empty() : !plan.affects(index.type())) continue;
    OrbitRepair& repair = effects_->repair(index.type());
    changed_.emplace_back(index, repair);
    if (classes != nullptr) {
      const auto number = static_cast<std::size_t>(classes - plan.orbits.data());
      follow_classes(row_plan_->orbits[number], index, repair);
    } else {
      list_touched(plan, index.type());
      index.repair(state.map, touched_, {}, repair, repair_space_, journal());
    }
  }
  // Only now, because a new entry moves the others.
  for (ChangedOrbits& changed : changed_) changed.repair = effects_->find(changed.index->type());
}

void Rewriter::Implementation::list_touched(const compile::RewritePlan& plan, OrbitType type) {
  touched_.clear();
  for (const ColumnChange& change : plan.changes) {
    if (change.fate == NodeFate::Preserved && !type.meets(change.links)) continue;
    for (std::uint32_t row = 0; row < match_.rows; ++row) {
      touched_.push_back(match_.dart(row, change.column));
    }
  }
}

void Rewriter::Implementation::follow_classes(const RowPlan::Orbits& orbits, OrbitIndex& index,
                                              OrbitRepair& repair) {
  const std::size_t first = repair.orbits.size();
  const std::span<const DartId> touched = gather(orbits.open, touched_);
  const std::span<const DartId> whole = gather(orbits.whole, whole_);
  index.repair(state.map, touched, {whole, orbits.whole_ends}, repair, repair_space_, journal());
  if (orbits.kept.empty()) return;
  enter_kept(orbits, index);
  repair.visited_darts += orbits.kept_visits;
  publish_kept(index, first, repair);
}

void Rewriter::Implementation::enter_kept(const RowPlan::Orbits& orbits, OrbitIndex& index) {
  index.grow(state.map, journal());
  const DartId* const darts = match_.darts.data();
  for (const RowPlan::Link link : orbits.entered) {
    index.add_dart(darts[link.from], index.row(darts[link.to]));  // new: needs no record
  }
  kept_rows_.clear();
  for (const RowPlan::Place place : orbits.kept) kept_rows_.push_back(index.row(darts[place]));
  support::sort_once(kept_rows_);
}

/// Kept orbits take their place among those from number `first` on, which were repaired; those that
/// a repair met are there already.
void Rewriter::Implementation::publish_kept(const OrbitIndex& index, std::size_t first,
                                            OrbitRepair& repair) {
  const std::size_t repaired = repair.orbits.size();
  const auto before = [](const OrbitChange& a, const OrbitChange& b) {
    return a.smallest < b.smallest;
  };
  const auto at = [&](std::size_t k) {
    return repair.orbits.begin() + static_cast<std::ptrdiff_t>(k);
  };
  for (const Row row : kept_rows_) {
    const OrbitChange orbit{row, index.smallest(row),
                            static_cast<std::uint32_t>(repair.sources.size()), 1};
    const auto place = std::lower_bound(at(first), at(repaired), orbit, before);
    if (place != at(repaired) && place->row == row) continue;
    repair.orbits.push_back(orbit);
    repair.sources.push_back(row);
  }
  if (!std::is_sorted(at(first), repair.orbits.end(), before)) {
    std::sort(at(first), repair.orbits.end(), before);
  }
}

}  // namespace gmsim::engine
