// SPDX-License-Identifier: MIT
#include "engine/evaluate_at.h"

#include <utility>

namespace gmsim::engine {

namespace {

Frame frame_at(const DartExpression& expression, DartId dart) {
  Frame frame(expression.frame_size);
  frame.set(expression.dart, dart);
  return frame;
}

}  // namespace

std::optional<types::Value> value_at(TreeEvaluator& evaluator, const DartExpression& expression,
                                     DartId dart, std::optional<support::Diagnostic>& error) {
  Frame frame = frame_at(expression, dart);
  std::optional<types::Value> value = evaluator.evaluate(*expression.value, frame);
  if (!value) error = evaluator.take_failure().diagnostic;
  return value;
}

bool holds_at(TreeEvaluator& evaluator, const DartExpression& condition, DartId dart,
              std::optional<support::Diagnostic>& error) {
  Frame frame = frame_at(condition, dart);
  bool holds = false;
  if (evaluator.evaluate_bool(*condition.value, frame, holds)) return holds;
  EvalFailure failure = evaluator.take_failure();
  if (!failure.missing_optional) error = std::move(failure.diagnostic);
  return false;
}

}  // namespace gmsim::engine
