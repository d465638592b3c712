// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "engine/builtins.h"
#include "engine/matrix_product.h"
#include "engine/tree_walker.h"

namespace gmsim::engine {

using types::Expr;
using types::ExprKind;
using types::ValueKind;

namespace {

constexpr std::uint32_t kMaxComponents = 9;  // of a value that is no array

double compare(ExprKind kind, double a, double b) {
  switch (kind) {
    case ExprKind::Less:
      return a < b;
    case ExprKind::LessEqual:
      return a <= b;
    case ExprKind::Greater:
      return a > b;
    default:
      return a >= b;
  }
}

}  // namespace

double TreeWalker::scalar_arithmetic(const Expr& expr) {
  if (expr.kind == ExprKind::Equal) return equal(expr) ? 1.0 : 0.0;
  if (expr.kind == ExprKind::NotEqual) return equal(expr) ? 0.0 : 1.0;
  const double a = scalar(*expr.args[0]);
  if (expr.kind == ExprKind::Neg) return -a;
  const double b = scalar(*expr.args[1]);
  switch (expr.kind) {
    case ExprKind::Add:
      return a + b;
    case ExprKind::Sub:
      return a - b;
    case ExprKind::Mul:
      return a * b;
    case ExprKind::Div:
      return expr.type.kind == ValueKind::Int ? std::trunc(a / b) : a / b;
    case ExprKind::Pow:
      return power(a, b);
    default:
      return compare(expr.kind, a, b);
  }
}

bool TreeWalker::equal(const Expr& expr) {
  const std::uint32_t count =
      std::max(types::number_count(expr.args[0]->type), types::number_count(expr.args[1]->type));
  const Arena::Mark mark = frame_->arena_.mark();
  double* a = frame_->arena_.allocate(count);
  double* b = frame_->arena_.allocate(count);
  operand(*expr.args[0], count, a);
  operand(*expr.args[1], count, b);
  const bool result = std::equal(a, a + count, b);
  frame_->arena_.release(mark);
  return result;
}

/// A value with `count` components, which the literal 0 takes from the other operand.
void TreeWalker::operand(const Expr& expr, std::uint32_t count, double* out) {
  if (expr.type.kind == ValueKind::Zero) return void(std::fill_n(out, count, 0.0));
  numbers(expr, out);
}

void TreeWalker::arithmetic(const Expr& expr, double* out) {
  switch (expr.kind) {
    case ExprKind::Neg: {
      numbers(*expr.args[0], out);
      std::transform(out, out + types::number_count(expr.type), out, std::negate<>());
      return;
    }
    case ExprKind::Add:
    case ExprKind::Sub:
      return sum_or_difference(expr, out);
    case ExprKind::Div: {
      numbers(*expr.args[0], out);
      const double divisor = scalar(*expr.args[1]);
      const std::uint32_t count = types::number_count(expr.type);
      for (std::uint32_t i = 0; i < count; ++i) out[i] /= divisor;
      return;
    }
    default:
      return product(expr, out);
  }
}

void TreeWalker::sum_or_difference(const Expr& expr, double* out) {
  const std::uint32_t count = types::number_count(expr.type);
  const Arena::Mark mark = frame_->arena_.mark();
  double* b = frame_->arena_.allocate(count);
  operand(*expr.args[0], count, out);
  operand(*expr.args[1], count, b);
  const double sign = expr.kind == ExprKind::Add ? 1.0 : -1.0;
  for (std::uint32_t i = 0; i < count; ++i) out[i] += sign * b[i];
  frame_->arena_.release(mark);
}

void TreeWalker::product(const Expr& expr, double* out) {
  const Expr &left = *expr.args[0], &right = *expr.args[1];
  const std::uint32_t count = types::number_count(expr.type);
  if (types::is_scalar(left.type) || types::is_scalar(right.type)) {
    const bool first = types::is_scalar(left.type);
    double factor = 0.0;
    if (first) factor = scalar(left);
    numbers(first ? right : left, out);
    if (!first) factor = scalar(right);
    for (std::uint32_t i = 0; i < count; ++i) out[i] *= factor;
    return;
  }
  double a[kMaxComponents], b[kMaxComponents];
  const double* matrix = view(left, a);
  multiply(left.type.kind, matrix, right.type.kind, view(right, b), out);
}

void TreeWalker::convert(const Expr& expr, double* out) {
  operand(*expr.args[0], types::number_count(expr.type), out);
}

void TreeWalker::call(const Expr& expr, double* out) {
  double scratch[BuiltinCall::kMaxArguments][kMaxComponents];
  BuiltinCall arguments;
  arguments.overload = expr.number;
  for (std::size_t i = 0; i < expr.args.size(); ++i) {
    const Expr& argument = *expr.args[i];
    if (argument.type.kind == ValueKind::Zero) {
      std::fill_n(scratch[i], kMaxComponents, 0.0);
      arguments.arguments[i] = scratch[i];
    } else {
      arguments.arguments[i] = view(argument, scratch[i]);
    }
  }
  double result[kMaxComponents];  // arguments may live where the result goes
  builtin_function(expr.builtin)(arguments, result);
  std::copy_n(result, types::number_count(expr.type), out);
}

}  // namespace gmsim::engine
