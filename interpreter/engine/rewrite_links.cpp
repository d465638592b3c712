// SPDX-License-Identifier: MIT
// Rewriter: darts and links of a rule's right side.
#include <algorithm>

#include "engine/rewriter_implementation.h"

namespace gmsim::engine {

void Rewriter::Implementation::change_links(const compile::RewritePlan& plan) {
  if (plan.changes.empty()) return;
  add_darts(plan);
  write_links();
  append(row_plan_->touched, effects_->touched);
  effects_->changed_links =
      OrbitType::from_bits(effects_->changed_links.bits() | plan.changed_links.bits());
  remove_darts();
}

/// Created darts are numbered row by row.
void Rewriter::Implementation::add_darts(const compile::RewritePlan& plan) {
  if (!plan.creates()) return;
  const std::uint32_t count = match_.rows * plan.created_columns;
  std::uint32_t next = types::index(state.map.add_darts(count));
  for (std::uint32_t row = 0; row < match_.rows; ++row) {
    DartId* darts = match_.darts.data() + std::size_t{row} * match_.width + plan.kept_columns;
    for (std::uint32_t k = 0; k < plan.created_columns; ++k) darts[k] = DartId{next++};
  }
  effects_->created_darts += count;
}

/// Where a roll-back may come, what older darts are linked to is written through the map's journal.
void Rewriter::Implementation::write_links() {
  const DartId* const darts = match_.darts.data();
  for (int i = 0; i <= state.map.dimension(); ++i) {
    const auto& kept = row_plan_->kept_links[static_cast<std::size_t>(i)];
    const auto& created = row_plan_->created_links[static_cast<std::size_t>(i)];
    if (recording_) {
      for (const RowPlan::Link link : kept)
        state.map.set_alpha(i, darts[link.from], darts[link.to]);
    }
    if (created.empty() && (recording_ || kept.empty())) continue;
    const DartId first = recording_ ? darts[created.front().from] : DartId{0};
    DartId* const links = state.map.new_links(i, first).data() - types::index(first);
    for (const RowPlan::Link link : created) links[types::index(darts[link.from])] = darts[link.to];
    if (recording_) continue;
    for (const RowPlan::Link link : kept) links[types::index(darts[link.from])] = darts[link.to];
  }
}

void Rewriter::Implementation::remove_darts() {
  if (row_plan_->removed.empty()) return;
  const std::span<const DartId> removed = gather(row_plan_->removed, touched_);
  state.map.remove_darts(removed);
  effects_->removed_darts += removed.size();
}

/// Adds the darts at the places of the row table.
void Rewriter::Implementation::append(const std::vector<RowPlan::Place>& places,
                                      std::vector<DartId>& out) const {
  const DartId* const darts = match_.darts.data();
  const std::size_t begin = out.size();
  out.resize(begin + places.size());
  std::transform(places.begin(), places.end(), out.begin() + static_cast<std::ptrdiff_t>(begin),
                 [&](RowPlan::Place place) { return darts[place]; });
}

/// The darts at the places of the row table, in memory that they do not shrink.
std::span<const DartId> Rewriter::Implementation::gather(const std::vector<RowPlan::Place>& places,
                                                         std::vector<DartId>& memory) const {
  if (memory.size() < places.size()) memory.resize(places.size());
  const DartId* const darts = match_.darts.data();
  DartId* out = memory.data();
  for (const RowPlan::Place place : places) *out++ = darts[place];
  return std::span(memory).first(places.size());
}

}  // namespace gmsim::engine
