// SPDX-License-Identifier: MIT
// Operators. What is known is computed at once, in the order and with the rounding of the tree
// evaluator; the rest becomes nodes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compile/symbolic_walker.h"
#include "compile/value_parts.h"
#include "compile/whole_power.h"

namespace gmsim::compile {

using support::DiagnosticKind;
using types::Expr;
using types::ExprKind;
using types::ValueKind;

namespace {

bool is_number(const types::ValueType& type) {
  if (type.is_array()) return false;
  return type.kind == ValueKind::Bool || type.kind == ValueKind::Int ||
         type.kind == ValueKind::Real || type.kind == ValueKind::Zero;
}

bool is_vector(const types::ValueType& type) {
  return type.kind == ValueKind::Vec2 || type.kind == ValueKind::Vec3;
}

}  // namespace

ir::NodeId SymbolicWalker::make(const Expr& at, Op op, NodeId a, NodeId b, NodeId c,
                                std::uint32_t aux) {
  if (graph_ == nullptr || failed()) return ir::kNone;
  return graph_->make(op, a, b, c, aux, at.span);
}

ir::NodeId SymbolicWalker::number(double value) {
  return graph_ == nullptr ? ir::kNone : graph_->constant(value);
}

/// One node of a value; of a known number its constant.
ir::NodeId SymbolicWalker::part(const SymbolicValue& value, std::size_t which) const {
  if (graph_ == nullptr || failed()) return ir::kNone;
  return value.known ? graph_->constant(value.number) : value.parts.at(which);
}

SymbolicValue SymbolicWalker::of_parts(std::initializer_list<NodeId> parts) const {
  SymbolicValue value;
  if (graph_ != nullptr) value.parts = parts;
  return value;
}

SymbolicValue SymbolicWalker::mask(const Expr& at, NodeId real) {
  return of_parts({make(at, Op::Not, make(at, Op::Equal, real, number(0.0)))});
}

SymbolicValue SymbolicWalker::operand(const Expr& expr, const types::ValueType& type) {
  if (expr.type.kind != ValueKind::Zero || is_number(type)) return evaluate(expr);
  SymbolicValue value;
  if (graph_ == nullptr) return value;
  const ValueParts parts = value_parts(type);
  value.parts.assign(parts.count, graph_->zero(parts.kind));
  return value;
}

SymbolicValue SymbolicWalker::arithmetic(const Expr& expr) {
  switch (expr.kind) {
    case ExprKind::Neg:
      return negative(expr);
    case ExprKind::Add:
    case ExprKind::Sub:
      return sum_or_difference(expr);
    case ExprKind::Mul:
      return product(expr);
    case ExprKind::Div:
      return quotient_of(expr);
    default:
      return power(expr);
  }
}

SymbolicValue SymbolicWalker::negative(const Expr& expr) {
  SymbolicValue value = evaluate(*expr.args[0]);
  value.number = -value.number;
  for (NodeId& id : value.parts) id = make(expr, Op::Neg, id);
  return value;
}

SymbolicValue SymbolicWalker::sum_or_difference(const Expr& expr) {
  const SymbolicValue a = operand(*expr.args[0], expr.type);
  const SymbolicValue b = operand(*expr.args[1], expr.type);
  return add(expr, a, b, expr.type, expr.kind == ExprKind::Add ? Op::Add : Op::Sub);
}

SymbolicValue SymbolicWalker::add(const Expr& at, const SymbolicValue& a, const SymbolicValue& b,
                                  const types::ValueType& type, Op op) {
  if (a.known && b.known)
    return SymbolicValue::of(op == Op::Add ? a.number + b.number : a.number - b.number);
  SymbolicValue value;
  if (graph_ == nullptr || failed()) return value;
  for (std::uint32_t k = 0; k < value_parts(type).count; ++k)
    value.parts.push_back(make(at, op, part(a, k), part(b, k)));
  return value;
}

SymbolicValue SymbolicWalker::product(const Expr& expr) {
  const bool first = is_number(expr.args[0]->type), second = is_number(expr.args[1]->type);
  if (!first && !second) return matrix_product(expr);
  const SymbolicValue a = evaluate(*expr.args[0]), b = evaluate(*expr.args[1]);
  if (a.known && b.known) return SymbolicValue::of(a.number * b.number);
  SymbolicValue value = first ? b : a;
  const SymbolicValue& factor = first ? a : b;
  if (graph_ == nullptr || failed()) return value.known ? SymbolicValue{} : value;
  if (value.known) value = of_parts({part(value, 0)});
  const Op op = value_parts(expr.type).kind == ir::ValueKind::Real ? Op::Mul : Op::Scale;
  for (NodeId& id : value.parts) id = make(expr, op, part(factor, 0), id);
  return value;
}

SymbolicValue SymbolicWalker::matrix_product(const Expr& expr) {
  const SymbolicValue a = evaluate(*expr.args[0]), b = evaluate(*expr.args[1]);
  if (graph_ == nullptr || failed()) return {};
  const ValueKind left = expr.args[0]->type.kind, right = expr.args[1]->type.kind;
  if (left != ValueKind::Mat2) {
    if (is_vector(expr.args[1]->type))
      return of_parts({make(expr, Op::MatVec, a.parts[0], b.parts[0])});
    const auto full = [&](NodeId m, ValueKind kind) {
      return kind == ValueKind::Sym3 ? make(expr, Op::Full, m) : m;
    };
    return of_parts({make(expr, Op::MatMul, full(a.parts[0], left), full(b.parts[0], right))});
  }
  const std::size_t columns = is_vector(expr.args[1]->type) ? 1 : 2;
  SymbolicValue value;
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      const NodeId x = make(expr, Op::Mul, a.parts[2 * i], b.parts[j]);
      const NodeId y = make(expr, Op::Mul, a.parts[2 * i + 1], b.parts[columns + j]);
      value.parts.push_back(make(expr, Op::Add, x, y));
    }
  }
  return value;
}

SymbolicValue SymbolicWalker::quotient_of(const Expr& expr) {
  const SymbolicValue a = evaluate(*expr.args[0]), b = evaluate(*expr.args[1]);
  return divide(expr, a, b, expr.type);
}

SymbolicValue SymbolicWalker::divide(const Expr& at, const SymbolicValue& a,
                                     const SymbolicValue& b, const types::ValueType& type) {
  const bool whole = type.kind == ValueKind::Int;
  if (a.known && b.known) {
    const double ratio = a.number / b.number;
    return SymbolicValue::of(whole ? std::trunc(ratio) : ratio);
  }
  SymbolicValue value;
  if (graph_ == nullptr || failed()) return value;
  for (std::uint32_t k = 0; k < value_parts(type).count; ++k)
    value.parts.push_back(make(at, Op::Div, part(a, k), part(b, 0)));
  if (whole) {  // towards zero
    const NodeId ratio = value.parts[0];
    value.parts[0] = make(at, Op::Select, make(at, Op::Less, ratio, number(0.0)),
                          make(at, Op::Ceil, ratio), make(at, Op::Floor, ratio));
  }
  return value;
}

SymbolicValue SymbolicWalker::power(const Expr& expr) {
  const SymbolicValue base = evaluate(*expr.args[0]), exponent = evaluate(*expr.args[1]);
  if (base.known && exponent.known) {
    if (is_small_whole(exponent.number))
      return SymbolicValue::of(whole_power(base.number, exponent.number));
    if (exponent.number == 0.5) return SymbolicValue::of(std::sqrt(base.number));
  }
  if (graph_ == nullptr || failed()) return {};
  return of_parts({make(expr, Op::Pow, part(base, 0), part(exponent, 0))});
}

SymbolicValue SymbolicWalker::comparison(const Expr& expr) {
  const SymbolicValue a = evaluate(*expr.args[0]), b = evaluate(*expr.args[1]);
  const bool or_equal = expr.kind == ExprKind::LessEqual || expr.kind == ExprKind::GreaterEqual;
  const bool swapped = expr.kind == ExprKind::Greater || expr.kind == ExprKind::GreaterEqual;
  const SymbolicValue &low = swapped ? b : a, &high = swapped ? a : b;
  if (a.known && b.known) {
    const bool holds = or_equal ? low.number <= high.number : low.number < high.number;
    return SymbolicValue::of(holds ? 1.0 : 0.0);
  }
  if (graph_ == nullptr || failed()) return {};
  return of_parts({make(expr, or_equal ? Op::LessEqual : Op::Less, part(low, 0), part(high, 0))});
}

SymbolicValue SymbolicWalker::equality(const Expr& expr) {
  const bool negated = expr.kind == ExprKind::NotEqual;
  const SymbolicValue a = operand(*expr.args[0], expr.args[1]->type);
  const SymbolicValue b = operand(*expr.args[1], expr.args[0]->type);
  if (a.known && b.known)
    return SymbolicValue::of((a.number == b.number) != negated ? 1.0 : 0.0);
  if (graph_ == nullptr || failed()) return {};
  const auto& type = expr.args[0]->type.kind == ValueKind::Zero ? expr.args[1]->type
                                                                : expr.args[0]->type;
  const ValueParts parts = value_parts(type);
  const bool bools = type.kind == ValueKind::Bool && !type.is_array();
  NodeId same = graph_->mask(true);
  for (std::uint32_t k = 0; k < parts.count; ++k) {
    const NodeId x = bools ? make(expr, Op::AsReal, node(a, type)) : part(a, k);
    const NodeId y = bools ? make(expr, Op::AsReal, node(b, type)) : part(b, k);
    if (parts.kind == ir::ValueKind::Real) {
      same = make(expr, Op::And, same, make(expr, Op::Equal, x, y));
      continue;
    }
    for (std::uint32_t i = 0; i < parts.stride; ++i) {
      const NodeId xi = make(expr, Op::Component, x, ir::kNone, ir::kNone, i);
      const NodeId yi = make(expr, Op::Component, y, ir::kNone, ir::kNone, i);
      same = make(expr, Op::And, same, make(expr, Op::Equal, xi, yi));
    }
  }
  return of_parts({negated ? make(expr, Op::Not, same) : same});
}

SymbolicValue SymbolicWalker::logic(const Expr& expr) {
  const SymbolicValue a = evaluate(*expr.args[0]);
  if (expr.kind == ExprKind::Not) {
    if (a.known) return SymbolicValue::of(a.number == 0.0 ? 1.0 : 0.0);
    if (graph_ == nullptr || failed()) return {};
    return of_parts({make(expr, Op::Not, a.parts[0])});
  }
  const bool conjunction = expr.kind == ExprKind::And;
  if (a.known) {
    const bool decides = (a.number != 0.0) != conjunction;
    return decides ? a : evaluate(*expr.args[1]);
  }
  const SymbolicValue b = evaluate(*expr.args[1]);
  if (graph_ == nullptr || failed()) return {};
  return of_parts({make(expr, conjunction ? Op::And : Op::Or, a.parts[0],
                        node(b, {ValueKind::Bool}))});
}

SymbolicValue SymbolicWalker::tuple(const Expr& expr) {
  SymbolicValue value;
  for (const types::ExprPtr& argument : expr.args) {
    const SymbolicValue entry = evaluate(*argument);
    if (graph_ != nullptr) value.parts.push_back(part(entry, 0));
  }
  if (graph_ == nullptr || failed() || expr.type.kind == ValueKind::Vec2) return value;
  return of_parts({make(expr, Op::Vector, value.parts[0], value.parts[1], value.parts[2])});
}

SymbolicValue SymbolicWalker::component(const Expr& expr) {
  const SymbolicValue whole = evaluate(*expr.args[0]);
  if (graph_ == nullptr || failed()) return {};
  const auto which = static_cast<std::uint32_t>(expr.number);
  if (expr.args[0]->type.kind != ValueKind::Vec3) return of_parts({part(whole, which)});
  return of_parts({make(expr, Op::Component, part(whole, 0), ir::kNone, ir::kNone, which)});
}

SymbolicValue SymbolicWalker::element(const Expr& expr) {
  const SymbolicValue whole = evaluate(*expr.args[0]), index = evaluate(*expr.args[1]);
  if (failed()) return {};
  const std::uint32_t extent = expr.args[0]->type.extents.front();
  if (!index.known) {
    fail(DiagnosticKind::NotConstant, expr.args[1]->span,
         "this index depends on numbers that may change at every step");
    return {};
  }
  if (index.number < 0.0 || index.number >= extent) {
    fail(DiagnosticKind::BadIndex, expr.args[1]->span,
         fmt::format("index {} is outside of 0..{}", types::number_text(index.number), extent));
    return {};
  }
  if (graph_ == nullptr) return {};
  const std::uint32_t count = value_parts(expr.type).count;
  const auto first = whole.parts.begin() + static_cast<std::uint32_t>(index.number) * count;
  SymbolicValue value;
  value.parts.assign(first, first + count);
  const bool is_mask = expr.type.kind == ValueKind::Bool && !expr.type.is_array();
  return is_mask ? mask(expr, value.parts[0]) : value;
}

}  // namespace gmsim::compile
