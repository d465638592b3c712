// SPDX-License-Identifier: MIT
// Rewriter: the values of a rule's right side, computed on the map before the rewrite by a program;
// where that gives up, the trees are evaluated, one by one, and say what is missing.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/rewriter_implementation.h"

namespace gmsim::engine {

namespace {

bool all_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

}  // namespace

bool Rewriter::Implementation::evaluate(const compile::Rule& rule, RewriteOutcome& outcome) {
  if (rule.rewrite.assignments.empty()) return true;
  return run_program(rule) || evaluate_trees(rule, outcome);
}

/// False, with nothing assigned, when a value is missing or is no number: the trees say which.
bool Rewriter::Implementation::run_program(const compile::Rule& rule) {
  const compile::ValueProgram& program = programs_.find(rule);
  if (!program.complete || !machine_.run(program, match_, *row_plan_, frame_)) return false;
  for (const compile::ValueProgram::Output& output : program.outputs) {
    if (!all_finite(machine_.value(output.value))) return false;
  }
  for (const compile::ValueProgram::Output& output : program.outputs) {
    const compile::Assignment& assignment = rule.rewrite.assignments[output.assignment];
    const std::span<const double> values = machine_.value(output.value);
    const std::vector<std::uint32_t>& rows = row_plan_->groups(0, assignment.joined_rows()).first;
    std::size_t begin = numbers_.size();
    numbers_.insert(numbers_.end(), values.begin(), values.end());
    for (const std::uint32_t row : rows) {
      assigned_.push_back({&assignment, types::kNoDart, begin});
      assigned_cells_.emplace_back(row, assignment.column);
      begin += values.size() / rows.size();
    }
  }
  return true;
}

bool Rewriter::Implementation::evaluate_trees(const compile::Rule& rule, RewriteOutcome& outcome) {
  for (const compile::Assignment& assignment : rule.rewrite.assignments) {
    if (!state.store.in_use(assignment.embedding)) continue;
    for (const std::uint32_t row : row_plan_->groups(0, assignment.joined_rows()).first) {
      if (!evaluate_at(rule, assignment, row, outcome)) return false;
    }
  }
  return true;
}

bool Rewriter::Implementation::evaluate_at(const compile::Rule& rule,
                                           const compile::Assignment& assignment, std::uint32_t row,
                                           RewriteOutcome& outcome) {
  if (!bind_row(rule.match, row, outcome)) return false;
  const std::uint32_t stride = state.store.column(assignment.embedding).stride();
  const std::size_t begin = numbers_.size();
  numbers_.resize(begin + stride);
  const std::span<double> value = std::span(numbers_).subspan(begin);
  if (!matcher.evaluator().evaluate(*assignment.value, frame_, value)) {
    fail_evaluation(rule, outcome);
    return false;
  }
  if (!all_finite(value)) {
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
    outcome.status = missing ? RewriteOutcome::Status::NotMatched : RewriteOutcome::Status::Failed;
    outcome.error = outcome.failure.error;
    return false;
  }
  return true;
}

}  // namespace gmsim::engine
