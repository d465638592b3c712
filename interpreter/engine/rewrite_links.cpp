// SPDX-License-Identifier: MIT
// Rewriter: darts and links of a rule's right side.
#include "engine/rewriter_implementation.h"

namespace gmsim::engine {

using compile::ColumnChange;
using compile::NodeFate;

void Rewriter::Implementation::change_links(const compile::RewritePlan& plan) {
  if (plan.changes.empty()) return;
  add_darts(plan);
  write_links(plan);
  for (const ColumnChange& change : plan.changes) {
    for (std::uint32_t row = 0; row < match_.rows; ++row) {
      effects_.touched.push_back(match_.dart(row, change.column));
    }
  }
  remove_darts(plan);
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
  effects_.created_darts += count;
}

void Rewriter::Implementation::write_links(const compile::RewritePlan& plan) {
  for (const compile::LinkWrite& link : plan.writes) {
    for (std::uint32_t row = 0; row < match_.rows; ++row) {
      const DartId from = match_.dart(row, link.from);
      if (link.position != compile::LinkWrite::kExplicit) {
        const std::uint32_t next =
            match_.next_row(row, static_cast<std::uint32_t>(link.position));
        state.map.set_alpha(link.dimension, from, match_.dart(next, link.from));
        continue;
      }
      const DartId to = match_.dart(row, link.to);
      state.map.set_alpha(link.dimension, from, to);
      if (to != from) state.map.set_alpha(link.dimension, to, from);
    }
  }
}

void Rewriter::Implementation::remove_darts(const compile::RewritePlan& plan) {
  touched_.clear();
  for (const ColumnChange& change : plan.changes) {
    if (change.fate != NodeFate::Removed) continue;
    for (std::uint32_t row = 0; row < match_.rows; ++row) {
      touched_.push_back(match_.dart(row, change.column));
    }
  }
  if (touched_.empty()) return;
  state.map.remove_darts(touched_);
  effects_.removed_darts += touched_.size();
}

}  // namespace gmsim::engine
