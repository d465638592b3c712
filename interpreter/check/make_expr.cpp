// SPDX-License-Identifier: MIT
#include "check/make_expr.h"

#include <cmath>
#include <cstdlib>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace gmsim::check {
using types::Expr;
using types::Value;

ExprPtr make_literal(Value value, const types::MaybeUnit& unit, Span span) {
  Expr expr{.kind = ExprKind::Literal, .type = value.type, .unit = unit, .span = span};
  expr.value = std::move(value);
  return std::make_shared<const Expr>(std::move(expr));
}

ExprPtr make_local(Slot slot, const ValueType& type, const types::MaybeUnit& unit, Span span) {
  Expr expr{.kind = ExprKind::Local, .type = type, .unit = unit, .span = span};
  expr.slot = slot;
  return std::make_shared<const Expr>(std::move(expr));
}

ExprPtr make_error(Span span) {
  return std::make_shared<const Expr>(
      Expr{.kind = ExprKind::Literal, .type = {ValueKind::Error}, .unit = {}, .span = span});
}

ExprPtr make_let(Slot slot, ExprPtr bound, ExprPtr body) {
  Expr let{.kind = ExprKind::Let, .type = body->type, .unit = body->unit, .span = body->span};
  let.slot = slot;
  let.args = {std::move(bound), std::move(body)};
  return std::make_shared<const Expr>(std::move(let));
}

ExprPtr with_span(const ExprPtr& expr, Span span) {
  if (expr->span == span) return expr;
  Expr copy = *expr;
  copy.span = span;
  return std::make_shared<const Expr>(std::move(copy));
}

ExprPtr with_unit(const ExprPtr& expr, const types::MaybeUnit& unit) {
  if (expr->unit == unit) return expr;
  Expr copy = *expr;
  copy.unit = unit;
  return std::make_shared<const Expr>(std::move(copy));
}

bool has_kind(const ExprPtr& expr, ValueKind kind) {
  return expr->type.kind == kind && !expr->type.is_array();
}
bool is_error(const ExprPtr& expr) { return expr->type.kind == ValueKind::Error; }
bool is_literal(const ExprPtr& expr) { return expr->kind == ExprKind::Literal && !is_error(expr); }

std::optional<std::int64_t> constant_int(const ExprPtr& expr) {
  if (!is_literal(expr)) return std::nullopt;
  if (has_kind(expr, ValueKind::Zero)) return 0;
  if (!has_kind(expr, ValueKind::Int)) return std::nullopt;
  return static_cast<std::int64_t>(expr->value.as_real());
}

std::optional<bool> constant_bool(const ExprPtr& expr) {
  if (!is_literal(expr) || !has_kind(expr, ValueKind::Bool)) return std::nullopt;
  return expr->value.as_bool();
}

ExprPtr convert(const ExprPtr& expr, const ValueType& type) {
  if (is_error(expr) || expr->type == type || type.kind == ValueKind::Error) return expr;
  if (has_kind(expr, ValueKind::Zero)) {
    if (!is_storable(type)) return nullptr;
    return make_literal(Value::zero(type), expr->unit, expr->span);
  }
  if (!has_kind(expr, ValueKind::Int) || type != ValueType{ValueKind::Real}) return nullptr;
  if (is_literal(expr))
    return make_literal(Value::real(expr->value.as_real()), expr->unit, expr->span);
  Expr real{.kind = ExprKind::Convert, .type = type, .unit = expr->unit, .span = expr->span};
  real.args = {expr};
  return std::make_shared<const Expr>(std::move(real));
}

ExprPtr settle(const ExprPtr& expr) {
  if (!has_kind(expr, ValueKind::Zero)) return expr;
  return convert(expr, {ValueKind::Int});
}

bool is_walk(const Expr& expr) {
  const Expr* at = &expr;
  while (at->kind == ExprKind::Alpha) at = at->args[0].get();
  return at->kind == ExprKind::Local && at->type == ValueType{ValueKind::Dart};
}

// ---- walking ------------------------------------------------------------------------------------

namespace {

ExprPtr transform_with(const ExprPtr& expr, const std::function<ExprPtr(const Expr&)>& change,
                       std::unordered_map<const Expr*, ExprPtr>& done) {
  if (const auto found = done.find(expr.get()); found != done.end()) return found->second;
  ExprPtr result = expr;
  std::vector<ExprPtr> args;
  bool changed = false;
  for (const ExprPtr& arg : expr->args) {
    args.push_back(transform_with(arg, change, done));
    changed |= args.back() != arg;
  }
  if (changed) {
    Expr copy = *expr;
    copy.args = std::move(args);
    result = std::make_shared<const Expr>(std::move(copy));
  }
  if (ExprPtr other = change(*result)) result = std::move(other);
  done.emplace(expr.get(), result);
  return result;
}

void visit_with(const ExprPtr& expr, const std::function<void(const Expr&)>& visit,
                std::unordered_set<const Expr*>& done) {
  if (!expr || !done.insert(expr.get()).second) return;
  visit(*expr);
  for (const ExprPtr& arg : expr->args) visit_with(arg, visit, done);
}

}  // namespace

ExprPtr transform(const ExprPtr& expr, const std::function<ExprPtr(const Expr&)>& change) {
  if (!expr) return expr;
  std::unordered_map<const Expr*, ExprPtr> done;
  return transform_with(expr, change, done);
}

void for_each_node(const ExprPtr& expr, const std::function<void(const Expr&)>& visit) {
  std::unordered_set<const Expr*> done;
  visit_with(expr, visit, done);
}

std::set<Slot> slots_read(const ExprPtr& expr) {
  std::set<Slot> slots;
  for_each_node(expr, [&](const Expr& node) {
    if (node.kind == ExprKind::Local) slots.insert(node.slot);
  });
  return slots;
}

ExprPtr close_over(const ExprPtr& expr, const std::vector<Step>& steps) {
  ExprPtr closed = expr;
  std::set<Slot> wanted = slots_read(expr);
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    if (step->kind != Step::Kind::Let || !wanted.contains(step->slot)) continue;
    closed = make_let(step->slot, step->value, closed);
    wanted.merge(slots_read(step->value));
  }
  return closed;
}

}  // namespace gmsim::check
