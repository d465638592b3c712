// SPDX-License-Identifier: MIT
// Rewriter: the values of a rule's right side, evaluated on the map before the rewrite.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/rewriter_implementation.h"

namespace gmsim::engine {

bool Rewriter::Implementation::evaluate(const compile::Rule& rule, RewriteOutcome& outcome) {
  const TreeEvaluator::Keeping keeping(matcher.evaluator());
  for (const compile::Assignment& assignment : rule.rewrite.assignments) {
    if (!state.store.in_use(assignment.embedding)) continue;
    pick_rows(assignment.joined);
    for (const std::uint32_t row : rows_) {
      if (!evaluate_at(rule, assignment, row, outcome)) return false;
    }
  }
  return true;
}

/// The first row of each group that the joined positions connect.
void Rewriter::Implementation::pick_rows(const std::vector<std::uint32_t>& joined) {
  rows_.assign(1, 0);
  if (match_.rows == 1 || joined.size() == match_.positions) return;
  rows_.clear();
  row_seen_.assign(match_.rows, 0);
  for (std::uint32_t row = 0; row < match_.rows; ++row) {
    if (row_seen_[row] != 0) continue;
    rows_.push_back(row);
    walk_rows(row, joined);
  }
}

/// The rows of the group of `row`, into `row_queue_`; marks them as seen.
void Rewriter::Implementation::walk_rows(std::uint32_t row,
                                         const std::vector<std::uint32_t>& joined) {
  row_seen_[row] = 1;
  row_queue_.assign(1, row);
  if (joined.size() == 1) {  // a link leads back where it comes from
    const std::uint32_t other = match_.next_row(row, joined.front());
    row_seen_[other] = 1;
    if (other != row) row_queue_.push_back(other);
    return;
  }
  for (std::size_t next = 0; next < row_queue_.size(); ++next) {
    for (const std::uint32_t position : joined) {
      const std::uint32_t to = match_.next_row(row_queue_[next], position);
      if (row_seen_[to] == 0) row_queue_.push_back(to);
      row_seen_[to] = 1;
    }
  }
}

bool Rewriter::Implementation::evaluate_at(const compile::Rule& rule,
                                           const compile::Assignment& assignment,
                                           std::uint32_t row, RewriteOutcome& outcome) {
  if (!bind_row(rule.match, row, outcome)) return false;
  const std::uint32_t stride = state.store.column(assignment.embedding).stride();
  const std::size_t begin = numbers_.size();
  numbers_.resize(begin + stride);
  const std::span<double> value = std::span(numbers_).subspan(begin);
  if (!matcher.evaluator().evaluate(*assignment.value, frame_, value)) {
    fail_evaluation(rule, outcome);
    return false;
  }
  if (!std::all_of(value.begin(), value.end(), [](double x) { return std::isfinite(x); })) {
    const gmap::EmbeddingDecl& decl = state.program.schema[assignment.embedding];
    const types::Value shown{decl.type, {value.begin(), value.end()}};
    fail(rule,
         {support::DiagnosticKind::NonFinite,
          fmt::format("non-finite value of `{}`: {}", decl.name, types::to_string(shown)),
          assignment.value->span},
         outcome);
    return false;
  }
  assigned_.push_back({&assignment, types::kNoDart, begin});
  assigned_cells_.emplace_back(row, assignment.column);
  return true;
}

/// Puts the nodes of a row, and the lets that depend on them, into the frame.
bool Rewriter::Implementation::bind_row(const compile::MatchPlan& plan, std::uint32_t row,
                                        RewriteOutcome& outcome) {
  if (match_.rows == 1) return true;  // the match bound it
  for (compile::Column column = 0; column < plan.nodes.size(); ++column) {
    frame_.set(plan.nodes[column].slot, match_.dart(row, column));
  }
  for (std::uint32_t i = 0; i < plan.predicates.size(); ++i) {
    const compile::Predicate& predicate = plan.predicates[i];
    if (predicate.kind != compile::Predicate::Kind::Let) continue;
    if (judge_predicate(predicate, i, matcher.evaluator(), frame_, outcome.failure)) continue;
    const bool missing = outcome.failure.reason == MatchFailure::Reason::Missing;
    outcome.status =
        missing ? RewriteOutcome::Status::NotMatched : RewriteOutcome::Status::Failed;
    outcome.error = outcome.failure.error;
    return false;
  }
  return true;
}

}  // namespace gmsim::engine
