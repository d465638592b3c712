// SPDX-License-Identifier: MIT
#include "check/unit_rules.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gmsim::check {
using types::Expr;
using types::MaybeUnit;
using types::Unit;
namespace {

bool is_free_form(ExprKind kind) {
  switch (kind) {
    case ExprKind::Neg:
    case ExprKind::Add:
    case ExprKind::Sub:
    case ExprKind::Mul:
    case ExprKind::Div:
    case ExprKind::Pow:
    case ExprKind::Tuple:
    case ExprKind::Call:
    case ExprKind::Convert: return true;
    default: return false;
  }
}

/// exponent = numerator/denominator with a denominator up to 12, or nothing.
std::optional<std::pair<int, int>> as_fraction(double exponent) {
  if (std::abs(exponent) > 1000) return std::nullopt;
  for (int denominator = 1; denominator <= Unit::kDenominator; ++denominator) {
    const double numerator = exponent * denominator;
    if (std::abs(numerator - std::round(numerator)) < 1e-9)
      return std::pair{static_cast<int>(std::round(numerator)), denominator};
  }
  return std::nullopt;
}

ExprPtr scaled(const ExprPtr& expr, const MaybeUnit& unit, double scale) {
  if (scale == 1.0) return with_unit(expr, unit);
  if (is_literal(expr)) {
    types::Value value = expr->value;
    for (double& x : value.data) x *= scale;
    return make_literal(std::move(value), unit, expr->span);
  }
  Expr product{.kind = ExprKind::Mul, .type = expr->type, .unit = unit, .span = expr->span};
  product.args = {make_literal(types::Value::real(scale), std::nullopt, expr->span), expr};
  return make_expr(std::move(product));
}

}  // namespace

bool adopts_unit(const Expr& expr) {
  if (expr.unit || expr.type.kind == ValueKind::Bool) return false;
  if (expr.kind == ExprKind::Literal) return expr.type.kind != ValueKind::Error;
  if (expr.kind == ExprKind::If) return adopts_unit(*expr.args[1]) && adopts_unit(*expr.args[2]);
  return is_free_form(expr.kind) && !expr.args.empty() &&
         std::ranges::all_of(expr.args, [](const ExprPtr& arg) { return adopts_unit(*arg); });
}

ExprPtr adopt(const ExprPtr& expr, const MaybeUnit& unit, double scale) {
  if (!unit || !adopts_unit(*expr)) return expr;
  return scaled(expr, unit, scale);
}

MaybeUnit factor_unit(const Expr& expr) { return adopts_unit(expr) ? Unit{} : expr.unit; }

MaybeUnit product_unit(const Expr& a, const Expr& b) {
  if (adopts_unit(a) && adopts_unit(b)) return std::nullopt;
  const MaybeUnit left = factor_unit(a), right = factor_unit(b);
  return left && right ? MaybeUnit(*left * *right) : std::nullopt;
}

MaybeUnit quotient_unit(const Expr& a, const Expr& b) {
  if (adopts_unit(a) && adopts_unit(b)) return std::nullopt;
  const MaybeUnit left = factor_unit(a), right = factor_unit(b);
  return left && right ? MaybeUnit(*left / *right) : std::nullopt;
}

PowerUnit power_unit(const Expr& base, double exponent) {
  if (!base.unit || base.unit->dimensionless()) return {base.unit, true};
  const auto fraction = as_fraction(exponent);
  if (!fraction) return {std::nullopt, false};
  const auto unit = types::power(*base.unit, fraction->first, fraction->second);
  return {unit, unit.has_value()};
}

bool disagree(const MaybeUnit& a, const MaybeUnit& b) { return a && b && *a != *b; }

std::string unit_text(const MaybeUnit& unit) {
  return unit ? "[" + to_string(*unit) + "]" : "no unit";
}

std::string type_text(const ValueType& type, const MaybeUnit& unit) {
  return unit && !unit->dimensionless() ? to_string(type) + " " + unit_text(unit) : to_string(type);
}

}  // namespace gmsim::check
