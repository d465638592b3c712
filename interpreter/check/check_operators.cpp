// SPDX-License-Identifier: MIT
// Operators, `if`, tuples and indexing.
#include <algorithm>
#include <cmath>
#include <utility>

#include "check/check_expr.h"

namespace gmsim::check {
using support::DiagnosticKind;
using syntax::BinaryOp;
using types::Expr;
using types::MaybeUnit;
namespace {

std::string_view text_of(BinaryOp op) {
  switch (op) {
    case BinaryOp::Add: return "+";
    case BinaryOp::Sub: return "-";
    case BinaryOp::Mul: return "*";
    case BinaryOp::Div: return "/";
    case BinaryOp::Pow: return "^";
    case BinaryOp::Less: return "<";
    case BinaryOp::LessEqual: return "<=";
    case BinaryOp::Greater: return ">";
    case BinaryOp::GreaterEqual: return ">=";
    case BinaryOp::Equal: return "==";
    case BinaryOp::NotEqual: return "!=";
    case BinaryOp::And: return "and";
    case BinaryOp::Or: return "or";
  }
  return {};
}

ExprKind kind_of(BinaryOp op) {
  switch (op) {
    case BinaryOp::Add: return ExprKind::Add;
    case BinaryOp::Sub: return ExprKind::Sub;
    case BinaryOp::Mul: return ExprKind::Mul;
    case BinaryOp::Div: return ExprKind::Div;
    case BinaryOp::Pow: return ExprKind::Pow;
    case BinaryOp::Less: return ExprKind::Less;
    case BinaryOp::LessEqual: return ExprKind::LessEqual;
    case BinaryOp::Greater: return ExprKind::Greater;
    case BinaryOp::GreaterEqual: return ExprKind::GreaterEqual;
    case BinaryOp::Equal: return ExprKind::Equal;
    case BinaryOp::NotEqual: return ExprKind::NotEqual;
    case BinaryOp::And: return ExprKind::And;
    case BinaryOp::Or: return ExprKind::Or;
  }
  return ExprKind::Add;
}

bool is_scalar(const ExprPtr& e) {
  return has_kind(e, ValueKind::Real) || has_kind(e, ValueKind::Int) ||
         has_kind(e, ValueKind::Zero);
}

/// Numbers, vectors and matrices: what can be added, negated and scaled.
bool is_numeric(const ExprPtr& e) {
  if (e->type.is_array()) return false;
  switch (e->type.kind) {
    case ValueKind::Int:
    case ValueKind::Real:
    case ValueKind::Vec2:
    case ValueKind::Vec3:
    case ValueKind::Mat2:
    case ValueKind::Mat3:
    case ValueKind::Sym3:
    case ValueKind::Zero: return true;
    default: return false;
  }
}

ExprPtr to_real(const ExprPtr& e) {
  const ExprPtr real = convert(e, {ValueKind::Real});
  return real ? real : e;
}

/// A symmetric matrix as a full one, for products that are not symmetric.
ExprPtr full_matrix(const ExprPtr& e) {
  if (!has_kind(e, ValueKind::Sym3)) return e;
  Expr call{.kind = ExprKind::Call, .type = {ValueKind::Mat3}, .unit = e->unit, .span = e->span};
  call.builtin = types::Builtin::Mat;
  call.args = {e};
  return make_expr(std::move(call));
}

}  // namespace

// ---- agreement of two sides ---------------------------------------------------------------------

double ExprChecker::declared_scale(const Expr& expr) const {
  if (expr.kind == ExprKind::Embedding)
    return context_.env.library->schema[expr.embedding].unit_scale;
  if (expr.kind == ExprKind::Local && types::index(expr.slot) < context_.slot_scales.size())
    return context_.slot_scales[types::index(expr.slot)];
  return 1.0;
}

bool ExprChecker::unify_units(ExprPtr& a, ExprPtr& b, Span place, const std::string& what) {
  const bool free_a = adopts_unit(*a), free_b = adopts_unit(*b);
  if (free_a && !free_b) a = adopt(a, b->unit, declared_scale(*b));
  if (free_b && !free_a) b = adopt(b, a->unit, declared_scale(*a));
  if (!disagree(a->unit, b->unit)) return true;
  context_.report({.kind = DiagnosticKind::UnitMismatch,
                   .message = what + " " + unit_text(a->unit) + " and " + unit_text(b->unit),
                   .place = place,
                   .related = {{a->span, unit_text(a->unit)}, {b->span, unit_text(b->unit)}}});
  return false;
}

/// Brings both sides to one type and unit; false when that is reported to be impossible, or when the
/// types have nothing in common (then nothing is reported).
bool ExprChecker::unify(ExprPtr& a, ExprPtr& b, Span place, const std::string& what) {
  if (has_kind(a, ValueKind::Zero) && has_kind(b, ValueKind::Zero)) {
    a = settle(a);
    b = settle(b);
  }
  if (a->type != b->type) {
    if (ExprPtr converted = convert(a, b->type)) {
      a = std::move(converted);
    } else if ((converted = convert(b, a->type))) {
      b = std::move(converted);
    } else {
      return false;
    }
  }
  return unify_units(a, b, place, what);
}

ExprPtr ExprChecker::operator_mismatch(const syntax::BinaryExpr& expr, const ExprPtr& a,
                                       const ExprPtr& b) {
  std::string help;
  const auto vector = [](const ExprPtr& e) {
    return has_kind(e, ValueKind::Vec3) || has_kind(e, ValueKind::Vec2);
  };
  if (expr.op == BinaryOp::Mul && vector(a) && vector(b))
    help = "write `dot(…)`, `cross(…)` or `outer(…)`";
  const bool sym = has_kind(a, ValueKind::Sym3) || has_kind(b, ValueKind::Sym3);
  if (sym && (has_kind(a, ValueKind::Mat3) || has_kind(b, ValueKind::Mat3)))
    help = "`mat(s)` makes a sym3 a mat3, `sym(m)` takes the symmetric part";
  return type_mismatch(expr.op_span,
                       "`" + std::string(text_of(expr.op)) + "` does not work on " +
                           found_text(a) + " and " + found_text(b),
                       std::move(help));
}

// ---- unary and binary ---------------------------------------------------------------------------

ExprPtr ExprChecker::unary(const syntax::UnaryExpr& expr, Span span) {
  if (expr.op == syntax::UnaryOp::Not) {
    const ExprPtr operand = check_condition(expr.operand, "the operand of `not`");
    return is_error(operand) ? operand : make(ExprKind::Not, operand->type, {}, span, {operand});
  }
  const ExprPtr operand = check(expr.operand);
  if (is_error(operand)) return operand;
  if (!is_numeric(operand))
    return type_mismatch(operand->span, "`-` does not work on " + found_text(operand));
  return make(ExprKind::Neg, operand->type, operand->unit, span, {operand});
}

ExprPtr ExprChecker::binary(const syntax::BinaryExpr& expr, Span span) {
  switch (expr.op) {
    case BinaryOp::And:
    case BinaryOp::Or: return logic(expr, span);
    case BinaryOp::Less:
    case BinaryOp::LessEqual:
    case BinaryOp::Greater:
    case BinaryOp::GreaterEqual:
    case BinaryOp::Equal:
    case BinaryOp::NotEqual: return comparison(expr, span);
    case BinaryOp::Add:
    case BinaryOp::Sub: return sum(expr, span);
    case BinaryOp::Mul: return product(expr, span);
    case BinaryOp::Div: return division(expr, span);
    case BinaryOp::Pow: return power(expr, span);
  }
  return make_error(span);
}

/// A constant left side decides alone; the right side is then left out, so that it may name what this
/// dimension lacks.
ExprPtr ExprChecker::logic(const syntax::BinaryExpr& expr, Span span) {
  const bool conjunction = expr.op == BinaryOp::And;
  const std::string what = std::string("both sides of `") + (conjunction ? "and" : "or") + "`";
  const ExprPtr left = check_condition(expr.left, what);
  const auto known = constant_bool(left);
  if (known && *known != conjunction) return with_span(left, span);
  const ExprPtr right = check_condition(expr.right, what);
  if (known || is_error(right)) return right;
  if (is_error(left)) return left;
  const auto right_known = constant_bool(right);
  if (right_known) return *right_known == conjunction ? left : right;
  return make(kind_of(expr.op), {ValueKind::Bool}, {}, span, {left, right});
}

ExprPtr ExprChecker::comparison(const syntax::BinaryExpr& expr, Span span) {
  ExprPtr a = check(expr.left), b = check(expr.right);
  if (is_error(a) || is_error(b)) return make_error(span);
  const bool equality = expr.op == BinaryOp::Equal || expr.op == BinaryOp::NotEqual;
  if (equality && has_kind(a, ValueKind::Dart) && has_kind(b, ValueKind::Dart)) {
    const ExprPtr same = make(ExprKind::SameDart, {ValueKind::Bool}, {}, span, {a, b});
    if (expr.op == BinaryOp::Equal) return same;
    return make(ExprKind::Not, {ValueKind::Bool}, {}, span, {same});
  }
  const bool bools = equality && has_kind(a, ValueKind::Bool) && has_kind(b, ValueKind::Bool);
  if (!bools && !(is_scalar(a) && is_scalar(b))) return operator_mismatch(expr, a, b);
  if (!unify(a, b, expr.op_span, "this compares")) return make_error(span);
  return make(kind_of(expr.op), {ValueKind::Bool}, {}, span, {a, b});
}

ExprPtr ExprChecker::sum(const syntax::BinaryExpr& expr, Span span) {
  ExprPtr a = check(expr.left), b = check(expr.right);
  if (is_error(a) || is_error(b)) return make_error(span);
  const std::size_t errors = context_.diagnostics.all().size();
  if (!is_numeric(a) || !is_numeric(b)) return operator_mismatch(expr, a, b);
  const std::string what = expr.op == BinaryOp::Add ? "this adds" : "this subtracts";
  if (!unify(a, b, expr.op_span, what))
    return context_.diagnostics.all().size() == errors ? operator_mismatch(expr, a, b)
                                                       : make_error(span);
  return make(kind_of(expr.op), a->type, a->unit ? a->unit : b->unit, span, {a, b});
}

ExprPtr ExprChecker::product(const syntax::BinaryExpr& expr, Span span) {
  ExprPtr a = check(expr.left), b = check(expr.right);
  if (is_error(a) || is_error(b)) return make_error(span);
  if (!is_numeric(a) || !is_numeric(b)) return operator_mismatch(expr, a, b);
  a = settle(a);
  b = settle(b);
  const MaybeUnit unit = product_unit(*a, *b);
  if (is_scalar(a) && is_scalar(b)) {
    const bool ints = has_kind(a, ValueKind::Int) && has_kind(b, ValueKind::Int);
    if (!ints) {
      a = to_real(a);
      b = to_real(b);
    }
    return make(ExprKind::Mul, a->type, unit, span, {a, b});
  }
  if (is_scalar(a)) return make(ExprKind::Mul, b->type, unit, span, {to_real(a), b});
  if (is_scalar(b)) return make(ExprKind::Mul, a->type, unit, span, {a, to_real(b)});
  const bool matrix_a = has_kind(a, ValueKind::Mat3) || has_kind(a, ValueKind::Sym3);
  const bool matrix_b = has_kind(b, ValueKind::Mat3) || has_kind(b, ValueKind::Sym3);
  if (matrix_a && has_kind(b, ValueKind::Vec3))
    return make(ExprKind::Mul, b->type, unit, span, {a, b});
  if (matrix_a && matrix_b)
    return make(ExprKind::Mul, {ValueKind::Mat3}, unit, span, {full_matrix(a), full_matrix(b)});
  const bool plane = has_kind(b, ValueKind::Vec2) || has_kind(b, ValueKind::Mat2);
  if (has_kind(a, ValueKind::Mat2) && plane)
    return make(ExprKind::Mul, b->type, unit, span, {a, b});
  return operator_mismatch(expr, a, b);
}

ExprPtr ExprChecker::division(const syntax::BinaryExpr& expr, Span span) {
  ExprPtr a = check(expr.left);
  if (has_kind(a, ValueKind::Darts)) return quotient(a, expr, span);
  ExprPtr b = check(expr.right);
  if (is_error(a) || is_error(b)) return make_error(span);
  if (!is_numeric(a) || !is_scalar(b)) return operator_mismatch(expr, a, b);
  a = settle(a);
  if (is_scalar(a)) a = to_real(a);
  b = to_real(settle(b));
  return make(ExprKind::Div, a->type, quotient_unit(*a, *b), span, {a, b});
}

ExprPtr ExprChecker::quotient(const ExprPtr& orbit, const syntax::BinaryExpr& expr, Span span) {
  const ExprPtr classes = check(expr.right);
  if (is_error(classes)) return make_error(span);
  if (orbit->kind != ExprKind::OrbitDarts || !has_kind(classes, ValueKind::Orbit))
    return type_mismatch(has_kind(classes, ValueKind::Orbit) ? orbit->span : classes->span,
                         "`/` takes the darts of an orbit and the name of another, as in "
                         "`vertex(a) / corner`");
  Expr quotient{.kind = ExprKind::Quotient, .type = {ValueKind::Darts}, .unit = {}, .span = span};
  quotient.args = orbit->args;
  quotient.orbit = orbit->orbit;
  quotient.orbit2 = classes->orbit;
  return make_expr(std::move(quotient));
}

ExprPtr ExprChecker::power(const syntax::BinaryExpr& expr, Span span) {
  ExprPtr base = check(expr.left);
  ExprPtr exponent = settle(check(expr.right));
  if (is_error(base) || is_error(exponent)) return make_error(span);
  if (!is_scalar(base) || !is_scalar(exponent)) return operator_mismatch(expr, base, exponent);
  if (!is_literal(exponent)) {
    context_.report({.kind = DiagnosticKind::NotConstant,
                     .message = "an exponent must be a constant",
                     .place = exponent->span,
                     .help = "`exp(e * log(x))` takes any exponent"});
    return make_error(span);
  }
  const PowerUnit unit = power_unit(*base, exponent->value.as_real());
  if (!unit.valid || disagree(exponent->unit, types::Unit{})) {
    context_.report({.kind = DiagnosticKind::UnitMismatch,
                     .message = unit.valid ? "an exponent has no unit"
                                           : unit_text(base->unit) + " has no such power",
                     .place = exponent->span});
    return make_error(span);
  }
  const bool whole = has_kind(exponent, ValueKind::Int) && exponent->value.as_real() >= 0;
  base = whole ? settle(base) : to_real(settle(base));
  if (has_kind(base, ValueKind::Real)) exponent = to_real(exponent);
  return make(ExprKind::Pow, base->type, unit.unit, span, {base, exponent});
}

// ---- if, tuples, arrays -------------------------------------------------------------------------

/// Of a constant condition only the branch taken is looked at.
ExprPtr ExprChecker::choice(const syntax::IfExpr& expr, Span span) {
  const ExprPtr condition = check_condition(expr.condition, "a condition");
  if (const auto known = constant_bool(condition))
    return check(*known ? expr.then_value : expr.else_value);
  ExprPtr a = check(expr.then_value), b = check(expr.else_value);
  if (is_error(condition) || is_error(a) || is_error(b)) return make_error(span);
  const bool storable = is_storable(a->type) || has_kind(a, ValueKind::Zero);
  const bool darts = has_kind(a, ValueKind::Dart) && has_kind(b, ValueKind::Dart);
  const std::size_t errors = context_.diagnostics.all().size();
  if ((!storable && !darts) || !unify(a, b, span, "the branches are in")) {
    if (context_.diagnostics.all().size() != errors) return make_error(span);
    return type_mismatch(b->span, "the branches of `if` are " + found_text(a) + " and " +
                                      found_text(b));
  }
  return make(ExprKind::If, a->type, a->unit ? a->unit : b->unit, span, {condition, a, b});
}

ExprPtr ExprChecker::tuple(const syntax::TupleExpr& expr, Span span) {
  const std::size_t size = expr.elements.size();
  if (size != 2 && size != 3)
    return type_mismatch(span, "a vector has 2 or 3 components, this has " + std::to_string(size));
  std::vector<ExprPtr> elements;
  for (const syntax::ExprPtr& element : expr.elements)
    elements.push_back(check_as(element, {.type = {ValueKind::Real}, .what = "a component"}));
  if (std::ranges::any_of(elements, is_error)) return make_error(span);
  // Bare numbers follow the components that have a unit.
  const auto leader =
      std::ranges::find_if(elements, [](const ExprPtr& e) { return !adopts_unit(*e); });
  MaybeUnit unit;
  if (leader != elements.end()) {
    ExprPtr first = *leader;
    for (ExprPtr& element : elements)
      if (!unify_units(first, element, span, "the components are in")) return make_error(span);
    for (const ExprPtr& element : elements)
      if (element->unit) unit = element->unit;
  }
  const ValueType type{size == 2 ? ValueKind::Vec2 : ValueKind::Vec3};
  const ExprPtr vector = make(ExprKind::Tuple, type, unit, span, std::move(elements));
  if (!expr.unit) return vector;
  const auto declared = resolve_unit(context_, *expr.unit);
  if (!declared) return make_error(span);
  return coerce(vector, {.type = type, .unit = declared->unit, .scale = declared->scale,
                         .what = "this vector"});
}

ExprPtr ExprChecker::index(const syntax::IndexExpr& expr, Span span) {
  const ExprPtr array = check(expr.object);
  const ExprPtr position =
      check_as(expr.index, {.type = {ValueKind::Int}, .what = "an index"});
  if (is_error(array) || is_error(position)) return make_error(span);
  if (!array->type.is_array()) {
    const bool vector = has_kind(array, ValueKind::Vec3) || has_kind(array, ValueKind::Vec2);
    return type_mismatch(array->span, "only arrays have an index, this is " + found_text(array),
                         vector ? "components are `.x`, `.y` and `.z`" : "");
  }
  const std::int64_t size = array->type.extents.front();
  std::optional<std::pair<std::int64_t, std::int64_t>> values;
  if (const auto constant = constant_int(position)) values = {*constant, *constant + 1};
  if (position->kind == ExprKind::Local)
    for (const Binding& binding : context_.scope.bindings())
      if (binding.range && binding.value->slot == position->slot) values = binding.range;
  if (values && values->first < values->second && (values->first < 0 || values->second > size)) {
    const std::int64_t wrong = values->first < 0 ? values->first : values->second - 1;
    context_.report({.kind = DiagnosticKind::BadIndex,
                     .message = "index " + std::to_string(wrong) + " is outside of 0.." +
                                std::to_string(size),
                     .place = position->span});
    return make_error(span);
  }
  return make(ExprKind::Index, array->type.element(), array->unit, span, {array, position});
}

}  // namespace gmsim::check
