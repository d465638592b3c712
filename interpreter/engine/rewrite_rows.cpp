// SPDX-License-Identifier: MIT
#include "engine/rewrite_rows.h"

#include <algorithm>
#include <numeric>

namespace gmsim::engine {

using compile::Column;
using compile::ColumnChange;
using compile::LinkWrite;
using compile::NodeFate;
using compile::OrbitClass;

namespace {

using Place = RowPlan::Place;

/// Fills in one plan.
class RowPlanner {
 public:
  RowPlanner(const compile::Rule& rule, const Match& match, RowPlan& out)
      : plan_(rule.rewrite), match_(match), out_(out) {}

  void run() {
    out_.next = match_.next;
    for (const LinkWrite& write : plan_.writes) list_links(write);
    for (const ColumnChange& change : plan_.changes) {
      list_column(change.column, out_.touched);
      if (change.fate == NodeFate::Removed) list_column(change.column, out_.removed);
    }
    for (const compile::OrbitClasses& classes : plan_.orbits) {
      RowPlan::Orbits& orbits = out_.orbits.emplace_back();
      for (const OrbitClass& entry : classes.classes) list_orbits(entry, orbits);
    }
  }

 private:
  [[nodiscard]] Place place(std::uint32_t row, Column column) const {
    return row * match_.width + column;
  }
  void list_column(Column column, std::vector<Place>& out) const {
    for (std::uint32_t row = 0; row < match_.rows; ++row) out.push_back(place(row, column));
  }

  void list_links(const LinkWrite& write) {
    for (std::uint32_t row = 0; row < match_.rows; ++row) {
      if (write.position != LinkWrite::kExplicit) {
        const auto position = static_cast<std::uint32_t>(write.position);
        list_link(write.dimension, row, write.from, match_.next_row(row, position), write.from);
        continue;
      }
      list_link(write.dimension, row, write.from, row, write.to);
      if (write.to != write.from) list_link(write.dimension, row, write.to, row, write.from);
    }
  }
  void list_link(std::int8_t dimension, std::uint32_t row, Column from, std::uint32_t to_row,
                 Column to) {
    const auto i = static_cast<std::size_t>(dimension);
    auto& links = from < plan_.kept_columns ? out_.kept_links[i] : out_.created_links[i];
    links.push_back({place(row, from), place(to_row, to)});
  }

  void list_orbits(const OrbitClass& entry, RowPlan::Orbits& out) {
    switch (entry.fate) {
      case OrbitClass::Fate::Open:
        for (std::uint32_t row = 0; row < match_.rows; ++row) {
          for (const Column column : entry.columns) out.open.push_back(place(row, column));
        }
        return;
      case OrbitClass::Fate::Whole:
        each_group(entry.joined, [&](const auto& group) {
          for (const std::uint32_t row : group) {
            for (const Column column : entry.columns) out.whole.push_back(place(row, column));
          }
          out.whole_ends.push_back(static_cast<std::uint32_t>(out.whole.size()));
        });
        return;
      case OrbitClass::Fate::Kept:
        for (std::uint32_t row = 0; row < match_.rows; ++row) {
          for (const Column column : entry.columns) {
            out.entered.push_back({place(row, column), place(row, entry.kept)});
          }
        }
        each_group(entry.joined, [&](const auto& group) {
          out.kept.push_back(place(group.front(), entry.kept));
        });
        out.kept_visits += std::uint64_t{match_.rows} * (entry.columns.size() + 1);
    }
  }

  /// Calls visit(rows) for each group of rows that the label positions in `joined` connect, in the
  /// order of their first rows.
  template <typename Visit>
  void each_group(const std::vector<std::uint32_t>& joined, const Visit& visit) {
    seen_.assign(match_.rows, 0);
    for (std::uint32_t first = 0; first < match_.rows; ++first) {
      if (seen_[first] != 0) continue;
      seen_[first] = 1;
      group_.assign(1, first);
      for (std::size_t k = 0; k < group_.size(); ++k) {
        for (const std::uint32_t position : joined) {
          const std::uint32_t to = match_.next_row(group_[k], position);
          if (seen_[to] == 0) group_.push_back(to);
          seen_[to] = 1;
        }
      }
      visit(group_);
    }
  }

  const compile::RewritePlan& plan_;
  const Match& match_;
  RowPlan& out_;
  std::vector<std::uint8_t> seen_;
  std::vector<std::uint32_t> group_;
};

}  // namespace

RowPlan::RowPlan(const compile::Rule& rule, const Match& match)
    : rows_(match.rows), positions_(match.positions) {
  RowPlanner(rule, match, *this).run();
}

const RowPlan::Groups& RowPlan::groups(std::uint8_t chosen, std::uint8_t joined) {
  for (const KnownGroups& known : groups_) {
    if (known.chosen == chosen && known.joined == joined) return known.groups;
  }
  constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> rows(rows_);
  std::iota(rows.begin(), rows.end(), 0u);
  if (chosen != 0) rows = this->groups(0, chosen).first;
  Groups groups;
  groups.of.assign(rows_, kNone);
  std::vector<std::uint32_t> group;
  for (const std::uint32_t first : rows) {
    if (groups.of[first] != kNone) continue;
    const auto number = static_cast<std::uint32_t>(groups.first.size());
    groups.first.push_back(first);
    groups.of[first] = number;
    group.assign(1, first);
    for (std::size_t k = 0; k < group.size(); ++k) {
      for (std::uint32_t position = 0; position < positions_; ++position) {
        if ((joined >> position & 1u) == 0) continue;
        const std::uint32_t to = next[std::size_t{group[k]} * positions_ + position];
        if (groups.of[to] != kNone) continue;
        groups.of[to] = number;
        group.push_back(to);
      }
    }
  }
  return groups_.emplace_back(KnownGroups{chosen, joined, std::move(groups)}).groups;
}

RowPlan& RowPlans::find(const compile::Rule& rule, const Match& match) {
  if (last_rule_ != &rule) {
    last_rule_ = &rule;
    last_ = &rules_[&rule];
  }
  for (const auto& plan : last_->plans) {
    if (plan->next == match.next) return *plan;
  }
  return add(*last_, rule, match);
}

RowPlan& RowPlans::add(OfRule& of, const compile::Rule& rule, const Match& match) {
  auto plan = std::make_unique<RowPlan>(rule, match);
  if (match.rows > kMostRows) return *(large_ = std::move(plan));
  if (of.plans.size() < kMostPlans) return *of.plans.emplace_back(std::move(plan));
  auto& place = of.plans[of.oldest++ % kMostPlans];
  return *(place = std::move(plan));
}

}  // namespace gmsim::engine
