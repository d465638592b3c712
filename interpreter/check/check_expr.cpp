// SPDX-License-Identifier: MIT
#include "check/check_expr.h"

#include <utility>

namespace gmsim::check {
using support::DiagnosticKind;
using types::Expr;
using types::Value;
namespace {

/// Nesting of expressions, functions expanded, that is followed.
constexpr int kDeepest = 1000;

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};

std::string kind_text(const ValueType& type) {
  switch (type.kind) {
    case ValueKind::Darts: return "a collection of darts";
    case ValueKind::Forces: return "a collection of forces";
    case ValueKind::Dart: return "a dart";
    case ValueKind::Range: return "a range";
    case ValueKind::Orbit: return "the name of an orbit";
    case ValueKind::EigenPair: return "an eigenpair";
    case ValueKind::Zero: return "0";
    default: return to_string(type);
  }
}

}  // namespace

std::string found_text(const ExprPtr& expr) {
  return expr->type.is_array() ? to_string(expr->type) : kind_text(expr->type);
}

ExprPtr ExprChecker::check(const syntax::ExprPtr& expr) {
  return expr ? check(*expr) : make_error({});
}

ExprPtr ExprChecker::check(const syntax::Expr& expr) {
  if (context_.absence) return make_error(expr.span);
  if (depth_ >= kDeepest || context_.env.node_budget <= 0) {
    context_.report({.kind = DiagnosticKind::TooDeep,
                     .message = "this expression is too large once its functions are expanded",
                     .place = expr.span});
    context_.poison();
    return make_error(expr.span);
  }
  --context_.env.node_budget;
  ++depth_;
  const Span span = expr.span;
  ExprPtr result = std::visit(
      Overloaded{
          [&](const syntax::NumberExpr& e) { return number(e, span); },
          [&](const syntax::BoolExpr& e) {
            return make_literal(Value::boolean(e.value), std::nullopt, span);
          },
          [&](const syntax::DimensionExpr&) {
            return make_literal(Value::integer(context_.n()), std::nullopt, span);
          },
          [&](const syntax::NameExpr& e) { return name(e, span); },
          [&](const syntax::MemberExpr& e) { return member(e, span); },
          [&](const syntax::WalkExpr& e) { return walk(e, span); },
          [&](const syntax::IndexExpr& e) { return index(e, span); },
          [&](const syntax::CallExpr& e) { return call(e, span); },
          [&](const syntax::OrbitLiteralExpr& e) {
            const auto orbit = resolve_orbit(context_, e.orbit);
            return orbit ? orbit_call(*orbit, e.argument, span) : make_error(span);
          },
          [&](const syntax::AllExpr& e) { return all(e, span); },
          [&](const syntax::RangeExpr& e) { return range(e, span); },
          [&](const syntax::FoldExpr& e) { return fold(e, span); },
          [&](const syntax::UnaryExpr& e) { return unary(e, span); },
          [&](const syntax::BinaryExpr& e) { return binary(e, span); },
          [&](const syntax::IfExpr& e) { return choice(e, span); },
          [&](const syntax::TupleExpr& e) { return tuple(e, span); }},
      expr.node);
  --depth_;
  return result;
}

ExprPtr ExprChecker::check_as(const syntax::ExprPtr& expr, const Wanted& wanted) {
  return coerce(check(expr), wanted);
}

ExprPtr ExprChecker::coerce(const ExprPtr& expr, const Wanted& wanted) {
  if (is_error(expr)) return expr;
  ExprPtr value = convert(expr, wanted.type);
  if (!value)
    return type_mismatch(expr->span, wanted.what + " must be " + to_string(wanted.type) +
                                         ", this is " + found_text(expr));
  if (adopts_unit(*value)) return adopt(value, wanted.unit, wanted.scale);
  if (!disagree(value->unit, wanted.unit)) return value;
  context_.report({.kind = DiagnosticKind::UnitMismatch,
                   .message = wanted.what + " is in " + unit_text(wanted.unit) + ", this is in " +
                              unit_text(value->unit),
                   .place = expr->span});
  return make_error(expr->span);
}

ExprPtr ExprChecker::check_condition(const syntax::ExprPtr& expr, const std::string& what) {
  return check_as(expr, {.type = {ValueKind::Bool}, .what = what});
}

ExprPtr ExprChecker::check_dart(const syntax::ExprPtr& expr, const std::string& what) {
  return require_dart(check(expr), what);
}

ExprPtr ExprChecker::require_dart(const ExprPtr& expr, const std::string& what) {
  if (is_error(expr)) {
    if (context_.dart_uses && expr->kind == ExprKind::Local) {
      const auto& bindings = context_.scope.bindings();
      for (const Binding& binding : bindings)
        if (binding.unknown_argument && binding.value->slot == expr->slot &&
            !(*context_.dart_uses)[*binding.unknown_argument])
          (*context_.dart_uses)[*binding.unknown_argument] = expr->span;
    }
    return expr;
  }
  if (has_kind(expr, ValueKind::Dart)) return expr;
  const bool many = has_kind(expr, ValueKind::Darts);
  return type_mismatch(expr->span, what + " needs a dart, this is " + found_text(expr),
                       many ? "go over its darts, as in `sum(x in … : …)`" : "");
}

std::optional<Step> ExprChecker::check_let(const syntax::LetStatement& let, Span span,
                                           bool inline_walks) {
  if (let.parameters) {
    context_.declare({.name = let.name.text, .kind = Binding::Kind::Macro, .value = nullptr,
                      .span = let.name.span, .macro = &let, .visible = context_.scope.size()});
    return std::nullopt;
  }
  const ExprPtr value = settle(check(let.value));
  const bool walk = inline_walks && is_walk(*value);
  const bool stands_for_itself =
      is_literal(value) || is_error(value) || walk || has_kind(value, ValueKind::Darts);
  if (has_kind(value, ValueKind::Orbit) || has_kind(value, ValueKind::Range) ||
      has_kind(value, ValueKind::Forces)) {
    type_mismatch(value->span, "a `let` cannot hold " + found_text(value));
    context_.declare({.name = let.name.text, .value = make_error(span), .span = let.name.span});
    return std::nullopt;
  }
  if (stands_for_itself) {
    context_.declare({.name = let.name.text, .value = value, .span = let.name.span});
    return std::nullopt;
  }
  const ExprPtr local = context_.declare_slot(let.name, Binding::Kind::Let, value->type,
                                              value->unit, declared_scale(*value));
  return Step{Step::Kind::Let, local->slot, value};
}

ExprPtr ExprChecker::number(const syntax::NumberExpr& expr, Span span) {
  if (expr.unit) {
    const auto unit = resolve_unit(context_, *expr.unit);
    if (!unit) return make_error(span);
    return make_literal(Value::real(expr.value * unit->scale), unit->unit, span);
  }
  if (!expr.is_integer) return make_literal(Value::real(expr.value), std::nullopt, span);
  constexpr double kLargestInt = 9007199254740992.0;  // 2^53: every smaller whole number is exact
  if (expr.value > kLargestInt) return make_literal(Value::real(expr.value), std::nullopt, span);
  Value value = Value::integer(static_cast<std::int64_t>(expr.value));
  if (expr.value == 0.0) value.type = {ValueKind::Zero};
  return make_literal(std::move(value), std::nullopt, span);
}

ExprPtr ExprChecker::walk(const syntax::WalkExpr& expr, Span span) {
  const ExprPtr dart = check_dart(expr.object, "`@`");
  const auto link = resolve_link(context_, expr.dimension, DiagnosticKind::Dimension);
  if (!link || (is_error(dart) && !context_.dart_uses)) return make_error(span);
  Expr alpha{.kind = ExprKind::Alpha, .type = {ValueKind::Dart}, .unit = {}, .span = span};
  alpha.args = {dart};
  alpha.number = *link;
  return make_expr(std::move(alpha));
}

ExprPtr ExprChecker::type_mismatch(Span place, std::string message, std::string help) {
  context_.report({.kind = DiagnosticKind::TypeMismatch,
                   .message = std::move(message),
                   .place = place,
                   .help = std::move(help)});
  return make_error(place);
}

ExprPtr ExprChecker::make(ExprKind kind, ValueType type, types::MaybeUnit unit, Span span,
                          std::vector<ExprPtr> args) {
  Expr expr{.kind = kind, .type = std::move(type), .unit = std::move(unit), .span = span};
  expr.args = std::move(args);
  return make_expr(std::move(expr));
}

}  // namespace gmsim::check
