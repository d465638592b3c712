// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "check/make_expr.h"

namespace gmsim::check {
using types::Expr;
using types::Value;
namespace {

/// Powers up to this exponent are products, so their value does not depend on a library's pow().
constexpr int kLargestPower = 16;

std::optional<double> power(double base, double exponent) {
  const double whole = std::trunc(exponent);
  if (whole != exponent || std::abs(whole) > kLargestPower) return std::nullopt;
  double product = 1.0;
  for (int i = 0; i < static_cast<int>(std::abs(whole)); ++i) product *= base;
  if (whole < 0 && product == 0.0) return std::nullopt;
  return whole < 0 ? 1.0 / product : product;
}

std::optional<double> arithmetic(ExprKind kind, double a, double b) {
  switch (kind) {
    case ExprKind::Add: return a + b;
    case ExprKind::Sub: return a - b;
    case ExprKind::Mul: return a * b;
    case ExprKind::Div: return b == 0.0 ? std::nullopt : std::optional(a / b);
    case ExprKind::Pow: return power(a, b);
    case ExprKind::Less: return a < b;
    case ExprKind::LessEqual: return a <= b;
    case ExprKind::Greater: return a > b;
    case ExprKind::GreaterEqual: return a >= b;
    case ExprKind::Equal: return a == b;
    case ExprKind::NotEqual: return a != b;
    case ExprKind::And: return a != 0.0 && b != 0.0;
    case ExprKind::Or: return a != 0.0 || b != 0.0;
    default: return std::nullopt;
  }
}

/// Component by component where one side may be a scalar; empty when the kind does not work so.
std::optional<std::vector<double>> componentwise(ExprKind kind, const Value& a, const Value& b) {
  const bool same_size = a.data.size() == b.data.size();
  const bool scaled = kind == ExprKind::Mul || kind == ExprKind::Div;
  const bool both_scalar = types::is_scalar(a.type) && types::is_scalar(b.type);
  const bool sum = kind == ExprKind::Add || kind == ExprKind::Sub;
  const bool scalar_b = types::is_scalar(b.type);
  const bool scalar_a = types::is_scalar(a.type) && kind == ExprKind::Mul;
  if (!(both_scalar || (sum && same_size) || (scaled && (scalar_b || scalar_a))))
    return std::nullopt;
  std::vector<double> data;
  for (std::size_t i = 0; i < std::max(a.data.size(), b.data.size()); ++i) {
    const auto value = arithmetic(kind, a.data[a.data.size() == 1 ? 0 : i],
                                  b.data[b.data.size() == 1 ? 0 : i]);
    if (!value) return std::nullopt;
    data.push_back(*value);
  }
  return data;
}

std::optional<Value> fold(const Expr& expr, const std::vector<Value>& args) {
  switch (expr.kind) {
    case ExprKind::Neg: {
      Value value{expr.type, args[0].data};
      for (double& x : value.data) x = -x + 0.0;  // no negative zero from a written 0
      return value;
    }
    case ExprKind::Not: return Value::boolean(!args[0].as_bool());
    case ExprKind::Tuple: {
      Value value{expr.type, {}};
      for (const Value& arg : args) value.data.push_back(arg.as_real());
      return value;
    }
    case ExprKind::Component:
      if (args[0].type.kind == ValueKind::EigenPair) return std::nullopt;
      return Value::real(args[0].data.at(static_cast<std::size_t>(expr.number)));
    case ExprKind::Convert: return Value{expr.type, args[0].data};
    default: break;
  }
  if (args.size() != 2) return std::nullopt;
  auto data = componentwise(expr.kind, args[0], args[1]);
  if (!data || !std::ranges::all_of(*data, [](double x) { return std::isfinite(x); }))
    return std::nullopt;
  return Value{expr.type, std::move(*data)};
}

std::optional<Value> identity(const Expr& expr) {
  if (expr.kind != ExprKind::Call) return std::nullopt;
  if (expr.builtin == types::Builtin::Identity3)
    return Value{expr.type, {1, 0, 0, 0, 1, 0, 0, 0, 1}};
  if (expr.builtin == types::Builtin::Identity2) return Value{expr.type, {1, 0, 0, 1}};
  return std::nullopt;
}

}  // namespace

std::optional<Value> constant_value(const Expr& expr) {
  if (expr.type.kind == ValueKind::Error) return std::nullopt;
  if (expr.kind == ExprKind::Literal) return expr.value;
  if (auto value = identity(expr)) return value;
  if (expr.args.empty()) return std::nullopt;
  std::vector<Value> args;
  for (const ExprPtr& arg : expr.args) {
    auto value = constant_value(*arg);
    if (!value) return std::nullopt;
    args.push_back(std::move(*value));
  }
  return fold(expr, args);
}

ExprPtr make_expr(Expr expr) {
  const bool literals =
      !expr.args.empty() && std::ranges::all_of(expr.args, [](const ExprPtr& arg) {
        return is_literal(arg) && arg->type.kind != ValueKind::Orbit;
      });
  if (literals)
    if (auto value = constant_value(expr))
      return make_literal(std::move(*value), expr.unit, expr.span);
  return std::make_shared<const Expr>(std::move(expr));
}

}  // namespace gmsim::check
