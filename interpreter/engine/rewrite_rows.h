// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <unordered_map>
#include <vector>

#include "compile/program.h"
#include "engine/matcher.h"

namespace gmsim::engine {

/// What a rule does at every match whose rows are joined in one way, be it the triangles of a mesh
/// or its squares: the plan of the rule with all places in the row table filled in.
struct RowPlan {
  /// Where a dart is in the row table: row * width + column.
  using Place = std::uint32_t;
  struct Link {
    Place from = 0;
    Place to = 0;
  };
  /// An OrbitClasses of the plan, row by row.
  struct Orbits {
    std::vector<Place> open;
    std::vector<Place> whole;  ///< orbit after orbit
    std::vector<std::uint32_t> whole_ends;
    std::vector<Link> entered;  ///< a created dart and a dart of the orbit that it enters
    std::vector<Place> kept;    ///< a dart of every orbit that created darts enter
    std::uint64_t kept_visits = 0;
  };
  template <typename T>
  using ByDimension = std::array<std::vector<T>, types::kMaxDimension + 1>;

  /// Rows that stand for groups of them.
  struct Groups {
    std::vector<std::uint32_t> first;  ///< row of each group, ascending
    std::vector<std::uint32_t> of;     ///< for each row: number of its group
  };

  RowPlan(const compile::Rule& rule, const Match& match);
  /// Those that the label positions `joined` join, a bit for each position; but of the rows only
  /// the first ones of the groups that `chosen` join count. Made when asked for first.
  const Groups& groups(std::uint8_t chosen, std::uint8_t joined);

  std::vector<std::uint32_t> next;  ///< of the matches that it is for
  ByDimension<Link> kept_links;     ///< alpha(from) := to, at darts that are there already
  ByDimension<Link> created_links;  ///< the same at created darts
  std::vector<Place> touched;
  std::vector<Place> removed;
  std::vector<Orbits> orbits;       ///< for each entry of the plan's orbits

 private:
  struct KnownGroups {
    std::uint8_t chosen = 0, joined = 0;
    Groups groups;
  };
  std::uint32_t rows_ = 0;
  std::uint32_t positions_ = 0;
  std::deque<KnownGroups> groups_;  // which stay where they are
};

/// Row plans of the rules that were applied. Rules stay where they are while this lives.
class RowPlans {
 public:
  /// Valid until the next call.
  RowPlan& find(const compile::Rule& rule, const Match& match);

 private:
  static constexpr std::uint32_t kMostRows = 64;   // larger matches hardly ever come again
  static constexpr std::size_t kMostPlans = 16;    // of one rule
  struct OfRule {
    std::vector<std::unique_ptr<RowPlan>> plans;
    std::size_t oldest = 0;
  };

  RowPlan& add(OfRule& of, const compile::Rule& rule, const Match& match);

  std::unordered_map<const compile::Rule*, OfRule> rules_;
  const compile::Rule* last_rule_ = nullptr;
  OfRule* last_ = nullptr;
  std::unique_ptr<RowPlan> large_;
};

}  // namespace gmsim::engine
