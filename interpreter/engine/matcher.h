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
    HookLabels,  ///< the orbits of two hooks differ in shape
    Label,       ///< that of node `index` differs from the hook's
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
  using Plan = compile::MatchPlan;
  struct Stamp {
    std::uint32_t epoch = 0;
    std::uint32_t row = 0;
  };

  bool fail(MatchFailure::Reason reason, std::uint32_t index = 0);
  bool start(const Plan& plan, std::span<const DartId> hooks, Frame& frame, Match& out);
  bool step(const compile::LinkStep& step, DartId* row);
  bool follow_rows(const Plan& plan, Match& out);
  /// Predicates from number `next` on that may be judged once `links` links were followed.
  bool judge(const Plan& plan, std::uint32_t links, std::uint32_t& next, Frame& frame);
  /// Rows of labels of one or two positions: a path or a cycle, walked from row 0 both ways.
  bool grow_linear(const Plan& plan, Match& out);
  void list_path(const Plan& plan, Match& out);
  void make_rows(Match& out) const;
  bool follow_path(const Plan& plan, compile::Column hook, Match& out) const;
  bool grow_breadth_first(const Plan& plan, Match& out);
  /// Where the hooks of a row lead along a position, into `images_`.
  void lead(const Plan& plan, const Match& match, std::uint32_t row, std::uint32_t position);
  [[nodiscard]] bool images_are(const Plan& plan, const Match& match, std::uint32_t row) const;
  std::uint32_t add_row(const Plan& plan, Match& out) const;
  bool labels_hold(const Plan& plan, const Match& match);
  bool distinct(const Plan& plan, const Match& match);
  void next_epoch();

  const State& state_;
  MatcherKind kind_;
  TreeEvaluator evaluator_;
  MatchFailure failure_;
  std::vector<DartId> images_;
  std::vector<Stamp> stamps_;  // by dart
  std::uint32_t epoch_ = 0;
};

/// The naive matcher: the same answer from the pattern's links alone, without a plan. Rows come in
/// another order than the planned ones.
bool match_naively(const State& state, const compile::MatchPlan& plan,
                   std::span<const DartId> hooks, TreeEvaluator& evaluator, Frame& frame,
                   Match& out, MatchFailure& failure);

/// Judges one predicate: sets its slot or tests it. False: `failure` says why.
bool judge_predicate(const compile::Predicate& predicate, std::uint32_t index,
                     TreeEvaluator& evaluator, Frame& frame, MatchFailure& failure);

/// "there is no link `a -2- b`": the failure in the user's words; `plan` is the plan that failed.
[[nodiscard]] std::string describe(const MatchFailure& failure, const compile::MatchPlan& plan);

}  // namespace gmsim::engine
