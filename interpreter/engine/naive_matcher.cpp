// SPDX-License-Identifier: MIT
#include <algorithm>
#include <set>
#include <vector>

#include "engine/matcher.h"

namespace gmsim::engine {

namespace {

using compile::Column;
using Reason = MatchFailure::Reason;
using Tuple = std::vector<DartId>;  // one dart for each node

/// Matching as the definition has it: every dart is tried for every node, every link followed.
class NaiveMatcher {
 public:
  NaiveMatcher(const gmap::GMap& map, const compile::MatchPlan& plan) : map_(map), plan_(plan) {}

  Reason run(std::span<const DartId> hooks) {
    if (!add_row({hooks.begin(), hooks.end()})) return Reason::Link;
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      for (std::uint32_t position = 0; position < plan_.positions; ++position) {
        const Reason reason = close(row, position);
        if (reason != Reason::None) return reason;
      }
    }
    if (!labels_hold()) return Reason::Label;
    return injective() ? Reason::None : Reason::NotDistinct;
  }

  void write(Match& out) const {
    out.rows = static_cast<std::uint32_t>(rows_.size());
    out.width = plan_.width;
    out.positions = plan_.positions;
    out.darts.assign(rows_.size() * plan_.width, types::kNoDart);
    out.next = next_;
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      std::copy(rows_[row].begin(), rows_[row].end(), out.darts.begin() + row * plan_.width);
    }
  }

 private:
  [[nodiscard]] Tuple hooks_of(const Tuple& row) const {
    Tuple hooks;
    for (Column hook : plan_.hooks) hooks.push_back(row[hook]);
    return hooks;
  }

  bool add_row(const Tuple& hooks) {
    Tuple row(plan_.nodes.size(), types::kNoDart);
    for (std::size_t k = 0; k < hooks.size(); ++k) row[plan_.hooks[k]] = hooks[k];
    if (!links_hold(row) || !complete(row, 0)) return false;
    rows_.push_back(row);
    next_.resize(rows_.size() * plan_.positions);
    return true;
  }

  /// Tries every dart for the nodes from `column` on.
  bool complete(Tuple& row, Column column) const {
    while (column < row.size() && row[column] != types::kNoDart) ++column;
    if (column == row.size()) return true;
    for (std::uint32_t d = 0; d < map_.dart_end(); ++d) {
      if (!map_.alive(DartId{d})) continue;
      row[column] = DartId{d};
      if (links_hold(row) && complete(row, column + 1)) return true;
    }
    row[column] = types::kNoDart;
    return false;
  }

  /// Every link between nodes that have their darts.
  [[nodiscard]] bool links_hold(const Tuple& row) const {
    return std::all_of(plan_.arcs.begin(), plan_.arcs.end(), [&](const compile::PlanArc& arc) {
      if (row[arc.from] == types::kNoDart || row[arc.to] == types::kNoDart) return true;
      DartId end = row[arc.from];
      for (std::int8_t i : arc.dimensions) end = map_.alpha(i, end);
      return end == row[arc.to];
    });
  }

  /// Finds or makes the row that a label position leads to.
  Reason close(std::size_t row, std::uint32_t position) {
    Tuple hooks;
    for (Column hook : plan_.hooks) {
      hooks.push_back(map_.alpha(plan_.nodes[hook].label[position], rows_[row][hook]));
    }
    std::size_t target = 0;
    while (target < rows_.size() && hooks_of(rows_[target]).front() != hooks.front()) ++target;
    if (target == rows_.size() && !add_row(hooks)) return Reason::Link;
    if (hooks_of(rows_[target]) != hooks) return Reason::HookLabels;
    next_[row * plan_.positions + position] = static_cast<std::uint32_t>(target);
    return Reason::None;
  }

  [[nodiscard]] bool labels_hold() const {
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      for (Column column = 0; column < plan_.nodes.size(); ++column) {
        for (std::uint32_t position = 0; position < plan_.positions; ++position) {
          const std::int8_t entry = plan_.nodes[column].label[position];
          if (entry == compile::kNoEntry) continue;
          const Tuple& target = rows_[next_[row * plan_.positions + position]];
          if (map_.alpha(entry, rows_[row][column]) != target[column]) return false;
        }
      }
    }
    return true;
  }

  [[nodiscard]] bool injective() const {
    std::set<DartId> darts;
    for (const Tuple& row : rows_) darts.insert(row.begin(), row.end());
    return darts.size() == rows_.size() * plan_.nodes.size();
  }

  const gmap::GMap& map_;
  const compile::MatchPlan& plan_;
  std::vector<Tuple> rows_;
  std::vector<std::uint32_t> next_;
};

}  // namespace

bool match_naively(const State& state, const compile::MatchPlan& plan,
                   std::span<const DartId> hooks, TreeEvaluator& evaluator, Frame& frame,
                   Match& out, MatchFailure& failure) {
  if (hooks.size() != plan.hooks.size()) return failure.reason = Reason::HookCount, false;
  const bool alive = std::all_of(hooks.begin(), hooks.end(),
                                 [&](DartId d) { return state.map.alive(d); });
  if (!alive) return failure.reason = Reason::DeadHook, false;
  NaiveMatcher matcher(state.map, plan);
  failure.reason = matcher.run(hooks);
  if (failure.reason != Reason::None) return false;
  matcher.write(out);
  for (Column column = 0; column < plan.nodes.size(); ++column) {
    frame.set(plan.nodes[column].slot, out.dart(0, column));
  }
  for (std::uint32_t i = 0; i < plan.predicates.size(); ++i) {
    if (!judge_predicate(plan.predicates[i], i, evaluator, frame, failure)) return false;
  }
  return true;
}

}  // namespace gmsim::engine
