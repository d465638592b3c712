// SPDX-License-Identifier: MIT
// KernelForces: repairs where links have changed. Only matches that depend on a changed dart are
// looked at again, so the cost does not depend on the size of the mesh; tables, merged groups and the
// order of sums come out as if they had been made anew.
#include <algorithm>
#include <optional>
#include <set>
#include <tuple>

#include "engine/kernel_forces.h"
#include "gmap/orbit_walk.h"

namespace gmsim::engine {

bool KernelForces::repair(std::span<const DartId> touched) {
  for (const auto& of : interactions_)
    if (!of->repairable()) return false;
  find_changed(touched);
  sums_.grow(context_.vertices().row_end());
  for (const auto& of : interactions_) {
    repair(*of, touched);
    if (error_) return true;
  }
  if (stale_) {
    for (const auto& of : interactions_) of->merge_again();
    lay_out();
  } else {
    add_tasks();
    remember_vertices(touched);
  }
  return true;
}

void KernelForces::find_changed(std::span<const DartId> touched) {
  changed_.clear();
  for (const DartId dart : touched) {
    if (types::index(dart) < vertex_of_.size()) changed_.push_back(vertex_of_[types::index(dart)]);
    if (context_.state.map.alive(dart)) changed_.push_back(context_.vertices().row(dart));
  }
  std::sort(changed_.begin(), changed_.end());
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
  if (!changed_.empty() && changed_.back() == gmap::kNoRow) changed_.pop_back();
}

void KernelForces::remember_vertices(std::span<const DartId> touched) {
  const gmap::GMap& map = context_.state.map;
  const gmap::OrbitIndex& vertices = context_.vertices();
  vertex_of_.resize(map.dart_end(), gmap::kNoRow);
  for (const DartId dart : touched) {
    if (!map.alive(dart)) continue;
    if (vertex_of_[types::index(dart)] == vertices.row(dart)) continue;  // and all of its vertex
    gmap::for_each_dart(map, vertices.type(), dart,
                        [&](DartId d) { vertex_of_[types::index(d)] = vertices.row(d); });
  }
}

// ---- one interaction ----------------------------------------------------------------------------

void KernelForces::repair(InteractionTables& of, std::span<const DartId> touched) {
  std::vector<DartId> keys, hooks;
  for (const Row vertex : changed_) {
    of.watch().for_each(vertex, [&](DartId key) {
      if (of.place(key).shape != InteractionTables::kNowhere) keys.push_back(key);
    });
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  for (const DartId key : keys) hooks.push_back(of.hook(of.place(key)));
  for (const DartId dart : touched)
    if (context_.state.map.alive(dart)) of.hooks_near(dart, hooks);
  Repair repair{&of, std::vector<std::vector<DartId>>(of.shape_count())};
  for (const DartId key : keys) take_out(repair, key);
  find_again(repair, hooks);
  merge_again(repair);
}

void KernelForces::find_again(Repair& repair, std::span<const DartId> hooks) {
  InteractionTables& of = *repair.of;
  const gmap::GMap& map = context_.state.map;
  std::set<DartId> seen;
  for (const DartId hook : hooks) {
    if (!map.alive(hook)) continue;
    const DartId smallest = gmap::smallest_dart(map, of.body().orbit, hook);
    if (!seen.insert(smallest).second) continue;
    if (of.place(smallest).shape != InteractionTables::kNowhere) take_out(repair, smallest);
    std::optional<DartId> key;
    if ((error_ = of.find_at(hook, key))) return;
    if (of.shape_count() > repair.regroup.size()) stale_ = true;  // a table without a block
    if (key) put_in(repair, *key);
  }
}

void KernelForces::take_out(Repair& repair, DartId key) {
  InteractionTables& of = *repair.of;
  const InteractionTables::Place place = of.place(key);
  if (!stale_) {
    const MergedTable* merged = of.merged(place.shape);
    if (merged == nullptr) {
      unlink(block_of(of, place.shape), place.row);
    } else if (const std::uint32_t group = merged->group_of(key); group != gmap::kNoRow) {
      dissolve(repair, place.shape, group);
    }
  }
  of.remove(key);
}

void KernelForces::put_in(Repair& repair, DartId key) {
  if (stale_) return;
  InteractionTables& of = *repair.of;
  const InteractionTables::Place place = of.place(key);
  const MergedTable* merged = of.merged(place.shape);
  const ForceBlock& block = block_of(of, place.shape);
  if (merged != nullptr) {
    const MatchTable& table = of.table(place.shape);
    const auto& ends = merged->plan().ends;
    dissolve_between(repair, place.shape,
                     {table.rows(ends[0])[place.row], table.rows(ends[1])[place.row]});
    repair.regroup[place.shape].push_back(key);
  } else if (block.table->size() > block.capacity) {
    stale_ = true;
  } else {
    link(block, place.row);
  }
}

// ---- merged matches -----------------------------------------------------------------------------

void KernelForces::dissolve(Repair& repair, std::uint32_t shape, std::uint32_t group) {
  MergedTable& merged = *repair.of->merged(shape);
  unlink(block_of(*repair.of, shape), group);
  merged.members(group, repair.regroup[shape]);
  merged.remove(group);
}

/// All groups between two vertices, in whatever direction.
void KernelForces::dissolve_between(Repair& repair, std::uint32_t shape, std::array<Row, 2> ends) {
  const ForceBlock& block = block_of(*repair.of, shape);
  const auto is_between = [&](std::uint32_t slot) {
    if (slot < block.first || slot >= block.end()) return false;
    const std::uint32_t row = (slot - block.first) % block.capacity;
    const Row a = block.table->rows(0)[row], b = block.table->rows(1)[row];
    return (a == ends[0] && b == ends[1]) || (a == ends[1] && b == ends[0]);
  };
  while (true) {
    const std::span<const std::uint32_t> slots = sums_.slots(ends[0]);
    const auto found = std::find_if(slots.begin(), slots.end(), is_between);
    if (found == slots.end()) return;
    dissolve(repair, shape, (*found - block.first) % block.capacity);
  }
}

void KernelForces::merge_again(Repair& repair) {
  InteractionTables& of = *repair.of;
  for (std::uint32_t shape = 0; shape < repair.regroup.size() && !stale_; ++shape) {
    std::vector<DartId>& keys = repair.regroup[shape];
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    std::vector<std::uint32_t> rows;
    for (const DartId key : keys)  // those that are still there, with this shape
      if (of.place(key).shape == shape) rows.push_back(of.place(key).row);
    if (rows.empty()) continue;
    MergedTable& merged = *of.merged(shape);
    const ForceBlock& block = block_of(of, shape);
    const std::uint32_t before = merged.table().size();
    merged.group(of.table(shape), context_.state.store, rows);
    stale_ = merged.table().size() > block.capacity;
    for (std::uint32_t row = before; row < merged.table().size() && !stale_; ++row) link(block, row);
  }
}

// ---- sums ---------------------------------------------------------------------------------------

ForceBlock& KernelForces::block_of(const InteractionTables& of, std::uint32_t shape) {
  return blocks_[first_block_[of.number()] + shape];
}

std::size_t KernelForces::block_at(std::uint32_t slot) const {
  const auto after = std::upper_bound(blocks_.begin(), blocks_.end(), slot,
                                      [](std::uint32_t s, const ForceBlock& b) { return s < b.first; });
  return static_cast<std::size_t>(after - blocks_.begin()) - 1;
}

bool KernelForces::comes_before(std::uint32_t a, std::uint32_t b) const {
  const auto place = [&](std::uint32_t slot) {
    const ForceBlock& block = blocks_[block_at(slot)];
    const std::uint32_t within = slot - block.first;
    return std::tuple{block.interaction, block.table->key(within % block.capacity),
                      within / block.capacity};
  };
  return place(a) < place(b);
}

void KernelForces::link(const ForceBlock& block, std::uint32_t row) {
  for (std::uint32_t root = 0; root < block.roles.size(); ++root)
    sums_.insert(block.table->rows(block.roles[root])[row], block.slot(root, row),
                 [&](std::uint32_t a, std::uint32_t b) { return comes_before(a, b); });
}

void KernelForces::unlink(const ForceBlock& block, std::uint32_t row) {
  const std::uint32_t last = block.table->size() - 1;
  const auto vertex = [&](std::uint32_t root, std::uint32_t of) {
    return block.table->rows(block.roles[root])[of];
  };
  for (std::uint32_t root = 0; root < block.roles.size(); ++root)
    sums_.erase(vertex(root, row), block.slot(root, row));
  if (row == last) return;
  for (std::uint32_t root = 0; root < block.roles.size(); ++root)  // it moves into this row
    sums_.rename(vertex(root, last), block.slot(root, last), block.slot(root, row));
}

}  // namespace gmsim::engine
