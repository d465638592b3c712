// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "engine/dart_expression.h"
#include "engine/tree_eval.h"
#include "types/value.h"

namespace gmsim::engine {

/// The value of a scene's expression at a dart; empty after a failure, which is in `error`.
[[nodiscard]] std::optional<types::Value> value_at(TreeEvaluator& evaluator,
                                                   const DartExpression& expression, DartId dart,
                                                   std::optional<support::Diagnostic>& error);
/// A condition at a dart. Where it reads an optional value that is not there it does not hold, which is
/// no error.
[[nodiscard]] bool holds_at(TreeEvaluator& evaluator, const DartExpression& condition, DartId dart,
                            std::optional<support::Diagnostic>& error);

}  // namespace gmsim::engine
