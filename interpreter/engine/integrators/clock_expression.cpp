// SPDX-License-Identifier: MIT
#include "engine/integrators/clock_expression.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "compile/expression_search.h"

namespace gmsim::engine {
namespace {

using types::Expr;
using types::ExprKind;
using types::ExprPtr;

/// Replaces what does not change with the clock by its value.
class Folder {
 public:
  Folder(State& state, Frame& frame, Slot dart)
      : schema_(state.program.schema), evaluator_(state), frame_(frame) {
    known_.insert(types::index(dart));
  }

  ExprPtr fold(const ExprPtr& expr) {
    if (failure_) return expr;
    const bool constant = expr->kind != ExprKind::Literal && is_storable(expr->type) &&
                          !compile::reads_clock(*expr, schema_) && needs_only_known(*expr, known_);
    if (constant) return value_of(*expr);
    auto copy = std::make_shared<Expr>(*expr);
    if (expr->kind == ExprKind::Let) {
      fold_let(*copy);
    } else if (expr->kind == ExprKind::Fold) {
      fold_body(*copy);
    } else {
      for (ExprPtr& arg : copy->args) arg = fold(arg);
    }
    return copy;
  }

  [[nodiscard]] std::optional<support::Diagnostic> take_failure() { return std::move(failure_); }

 private:
  using Slots = std::unordered_set<std::uint32_t>;

  /// Every local that `expr` reads is bound inside of it or among `known`.
  static bool needs_only_known(const Expr& expr, const Slots& known) {
    if (expr.kind == ExprKind::Local) return known.contains(types::index(expr.slot));
    if (expr.kind != ExprKind::Let && expr.kind != ExprKind::Fold)
      return std::ranges::all_of(
          expr.args, [&](const ExprPtr& arg) { return needs_only_known(*arg, known); });
    if (!needs_only_known(*expr.args[0], known)) return false;
    Slots inside = known;
    inside.insert(types::index(expr.slot));
    return std::all_of(expr.args.begin() + 1, expr.args.end(), [&](const ExprPtr& arg) {
      return needs_only_known(*arg, inside);
    });
  }

  ExprPtr value_of(const Expr& expr) {
    std::optional<types::Value> value = evaluator_.evaluate(expr, frame_);
    if (!value) {
      failure_ = evaluator_.take_failure().diagnostic;
      return std::make_shared<Expr>(expr);
    }
    Expr literal{.type = expr.type, .unit = expr.unit, .span = expr.span};
    literal.value = std::move(*value);
    return std::make_shared<Expr>(std::move(literal));
  }

  void fold_let(Expr& let) {
    const bool constant = !compile::reads_clock(*let.args[0], schema_) && needs_only_known(*let.args[0], known_);
    const std::uint32_t slot = types::index(let.slot);
    let.args[0] = fold(let.args[0]);
    if (failure_) return;
    const Slots before = known_;
    if (constant && evaluator_.assign(*let.args[0], let.slot, frame_)) {
      known_.insert(slot);
    } else {
      known_.erase(slot);
    }
    if (evaluator_.failed()) failure_ = evaluator_.take_failure().diagnostic;
    let.args[1] = fold(let.args[1]);
    known_ = before;
  }

  void fold_body(Expr& fold_expr) {
    const Slots before = known_;
    fold_expr.args[0] = fold(fold_expr.args[0]);
    known_.erase(types::index(fold_expr.slot));
    for (std::size_t i = 1; i < fold_expr.args.size(); ++i)
      fold_expr.args[i] = fold(fold_expr.args[i]);
    known_ = before;
  }

  const gmap::EmbeddingSchema& schema_;
  TreeEvaluator evaluator_;
  Frame& frame_;
  Slots known_;
  std::optional<support::Diagnostic> failure_;
};

bool reads_slot(const Expr& expr, Slot slot) {
  if (expr.kind == ExprKind::Local && expr.slot == slot) return true;
  return std::ranges::any_of(expr.args,
                             [&](const ExprPtr& arg) { return reads_slot(*arg, slot); });
}

/// Sets the clock of a state for as long as it lives.
class ClockAt {
 public:
  ClockAt(State& state, double time) : state_(state), before_(state.time) { state.time = time; }
  ~ClockAt() { state_.time = before_; }
  ClockAt(const ClockAt&) = delete;
  ClockAt& operator=(const ClockAt&) = delete;

 private:
  State& state_;
  double before_;
};

}  // namespace

ClockExpression::ClockExpression(State& state, const DartExpression& expression, DartId dart)
    : state_(&state), frame_(expression.frame_size) {
  frame_.set(expression.dart, dart);
  Folder folder(state, frame_, expression.dart);
  residue_ = folder.fold(expression.value);
  error_ = folder.take_failure();
}

std::optional<std::array<double, 3>> ClockExpression::at(double time) {
  if (error_) return std::nullopt;
  const ClockAt clock(*state_, time);
  TreeEvaluator evaluator(*state_);
  std::array<double, 3> value{};
  if (!evaluator.evaluate(*residue_, frame_, value)) {
    error_ = evaluator.take_failure().diagnostic;
    return std::nullopt;
  }
  for (const double x : value)
    if (!std::isfinite(x)) {
      error_ = support::Diagnostic{support::DiagnosticKind::NonFinite,
                                   "the value of a prescribed motion is not finite",
                                   residue_->span};
      return std::nullopt;
    }
  return value;
}

std::optional<std::array<double, 3>> ClockExpression::rate(double time, double distance) {
  // Coefficients of f(t + k d) - f(t - k d), k = 1, 2, 3; Fornberg 1988.
  constexpr double kWeights[] = {3. / 4, -3. / 20, 1. / 60};
  std::array<double, 3> rate{};
  for (int k = 1; k <= 3; ++k) {
    const auto after = at(time + k * distance);
    const auto before = at(time - k * distance);
    if (!after || !before) return std::nullopt;
    for (std::size_t i = 0; i < 3; ++i)
      rate[i] += kWeights[k - 1] * ((*after)[i] - (*before)[i]) / distance;
  }
  return rate;
}

bool same_everywhere(const DartExpression& expression) {
  return !reads_slot(*expression.value, expression.dart);
}

}  // namespace gmsim::engine
