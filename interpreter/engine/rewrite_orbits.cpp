// SPDX-License-Identifier: MIT
// Rewriter: the orbits that a rule changes. Where the plan says what becomes of them, the map is not
// walked: created darts enter orbits that stay as they are, or orbits are listed from the match. Rows,
// effects and their order are those that a repair alone would give.
#include <algorithm>

#include "engine/rewriter_implementation.h"

namespace gmsim::engine {

using compile::ColumnChange;
using compile::NodeFate;
using compile::OrbitClass;
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
    changed_.push_back({&index, nullptr});
    OrbitRepair& repair = effects_.repair(index.type());
    if (classes != nullptr) {
      follow_classes(*classes, index, repair);
    } else {
      list_touched(plan, index.type());
      index.repair(state.map, touched_, repair, journal());
    }
  }
  // Only now, because a new entry moves the others.
  for (ChangedOrbits& changed : changed_) changed.repair = effects_.find(changed.index->type());
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

void Rewriter::Implementation::follow_classes(const OrbitClasses& classes, OrbitIndex& index,
                                              OrbitRepair& repair) {
  touched_.clear();
  whole_.clear();
  whole_ends_.clear();
  bool some_kept = false;
  for (const OrbitClass& orbits : classes.classes) {
    switch (orbits.fate) {
      case OrbitClass::Fate::Kept:
        some_kept = true;
        break;
      case OrbitClass::Fate::Whole:
        list_whole(orbits);
        break;
      case OrbitClass::Fate::Open:
        for (std::uint32_t row = 0; row < match_.rows; ++row) {
          for (const compile::Column column : orbits.columns) {
            touched_.push_back(match_.dart(row, column));
          }
        }
    }
  }
  index.repair(state.map, touched_, {whole_, whole_ends_}, repair, journal());
  if (!some_kept) return;
  index.grow(state.map, journal());
  kept_rows_.clear();
  for (const OrbitClass& orbits : classes.classes) {
    if (orbits.fate == OrbitClass::Fate::Kept) enter_kept(orbits, index, repair);
  }
  publish_kept(index, repair);
}

void Rewriter::Implementation::list_whole(const OrbitClass& orbits) {
  row_seen_.assign(match_.rows, 0);
  for (std::uint32_t row = 0; row < match_.rows; ++row) {
    if (row_seen_[row] != 0) continue;
    walk_rows(row, orbits.joined);
    for (const std::uint32_t member : row_queue_) {
      for (const compile::Column column : orbits.columns) {
        whole_.push_back(match_.dart(member, column));
      }
    }
    whole_ends_.push_back(static_cast<std::uint32_t>(whole_.size()));
  }
}

void Rewriter::Implementation::enter_kept(const OrbitClass& orbits, OrbitIndex& index,
                                          OrbitRepair& repair) {
  for (std::uint32_t row = 0; row < match_.rows; ++row) {
    const Row orbit = index.row(match_.dart(row, orbits.kept));
    if (kept_rows_.empty() || kept_rows_.back() != orbit) kept_rows_.push_back(orbit);
    for (const compile::Column column : orbits.columns) {
      index.add_dart(match_.dart(row, column), orbit, journal());
    }
  }
  repair.visited_darts += std::uint64_t{match_.rows} * (orbits.columns.size() + 1);
}

/// Kept orbits take their place among the repaired ones; those that a repair met are there already.
void Rewriter::Implementation::publish_kept(const OrbitIndex& index, OrbitRepair& repair) {
  const std::size_t repaired = repair.orbits.size();
  std::sort(kept_rows_.begin(), kept_rows_.end());
  kept_rows_.erase(std::unique(kept_rows_.begin(), kept_rows_.end()), kept_rows_.end());
  const auto before = [](const OrbitChange& a, const OrbitChange& b) {
    return a.smallest < b.smallest;
  };
  for (const Row row : kept_rows_) {
    const OrbitChange orbit{row, index.smallest(row),
                            static_cast<std::uint32_t>(repair.sources.size()), 1};
    const auto end = repair.orbits.begin() + static_cast<std::ptrdiff_t>(repaired);
    const auto place = std::lower_bound(repair.orbits.begin(), end, orbit, before);
    if (place != end && place->row == row) continue;
    repair.orbits.push_back(orbit);
    repair.sources.push_back(row);
  }
  if (repair.orbits.size() > repaired) {
    std::sort(repair.orbits.begin(), repair.orbits.end(), before);
  }
}

}  // namespace gmsim::engine
