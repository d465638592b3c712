// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compile/match_plan.h"
#include "engine/frame.h"
#include "engine/state.h"
#include "engine/tree_eval.h"

namespace gmsim::engine {

/// The row table of a match: row 0 holds the hook darts that were given.
struct Match {
  std::uint32_t rows = 0;
  std::uint32_t width = 0;      ///< columns
  std::uint32_t positions = 0;  ///< label length
  std::vector<DartId> darts;        ///< row by row
  std::vector<std::uint32_t> next;  ///< row by row: where each label position leads

  [[nodiscard]] DartId dart(std::uint32_t row, compile::Column column) const {
    return darts[std::size_t{row} * width + column];
  }
  [[nodiscard]] std::uint32_t next_row(std::uint32_t row, std::uint32_t position) const {
    return next[std::size_t{row} * positions + position];
  }
};

/// What kept a pattern from matching.
struct MatchFailure {
  enum class Reason : std::uint8_t {
    None,
    HookCount,   ///< not as many darts as hooks
    DeadHook,    ///< no such dart any more
    Link,        ///< arc `index` does not hold
    NotDistinct, ///< two nodes fall on one dart
    Label,       ///< the orbits of the nodes differ in shape
    Where,       ///< condition `index` (of the predicates) is false
    Missing,     ///< a condition reads an optional value where there is none
    Error        ///< a condition has no value: see `error`
  };
  Reason reason = Reason::None;
  std::uint32_t index = 0;
  std::optional<support::Diagnostic> error = std::nullopt;
};

enum class MatcherKind : std::uint8_t {
  Planned,
  Naive  ///< tries every dart for every node: slow, independent, for `--matcher naive`
};

/// Matches patterns at given hook darts. Keeps scratch memory; one per thread.
class Matcher {
 public:
  explicit Matcher(const State& state, MatcherKind kind = MatcherKind::Planned);

  /// The match of `plan` at `hooks`, if there is one. `frame` holds the caller's parameters and
  /// receives nodes (of row 0), parameter defaults and lets. False: see failure().
  bool match(const compile::MatchPlan& plan, std::span<const DartId> hooks, Frame& frame,
             Match& out);
  [[nodiscard]] const MatchFailure& failure() const { return failure_; }
  [[nodiscard]] TreeEvaluator& evaluator() { return evaluator_; }

 private:
  bool fail(MatchFailure::Reason reason, std::uint32_t index = 0);
  bool follow_links(const compile::MatchPlan& plan, Frame& frame, Match& out);
  bool follow_row(const compile::MatchPlan& plan, DartId* row);
  bool follow(const compile::LinkStep& step, DartId* row);
  bool judge(const compile::Predicate& predicate, std::uint32_t index, Frame& frame);
  bool grow_rows(const compile::MatchPlan& plan, Match& out);
  bool grow_chain(const compile::MatchPlan& plan, Match& out);
  bool grow_breadth_first(const compile::MatchPlan& plan, Match& out);
  bool labels_hold(const compile::MatchPlan& plan, const Match& match);
  bool distinct(const compile::MatchPlan& plan, const Match& match);

  const State& state_;
  MatcherKind kind_;
  TreeEvaluator evaluator_;
  MatchFailure failure_;
};

/// The naive matcher: the same answer from the pattern's links alone, without a plan. Rows come in
/// another order than the planned ones.
bool match_naively(const State& state, const compile::MatchPlan& plan,
                   std::span<const DartId> hooks, TreeEvaluator& evaluator, Frame& frame,
                   Match& out, MatchFailure& failure);

/// "`a` is 2-free, but the rule needs a 2-link there": the failure in the user's words, without
/// place; `plan` is the plan that failed.
[[nodiscard]] std::string describe(const MatchFailure& failure, const compile::MatchPlan& plan);

}  // namespace gmsim::engine
