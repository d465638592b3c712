// SPDX-License-Identifier: MIT
#include "compile/ir_simplify.h"

#include <cmath>

#include "compile/ir_simplifier.h"
#include "compile/whole_power.h"

namespace gmsim::compile::ir {

std::optional<NodeId> simplify(Graph& graph, Op op, NodeId a, NodeId b, NodeId c,
                               std::uint32_t aux, Span span) {
  return Simplifier(graph, op, a, b, c, aux, span).run();
}

std::optional<NodeId> Simplifier::run() {
  switch (op_) {
    case Op::Add: return add();
    case Op::Sub: return sub();
    case Op::Neg: return neg();
    case Op::Mul: return mul();
    case Op::Div: return div();
    case Op::Scale: return scale();
    case Op::Pow: return pow();
    case Op::Vector: return vector();
    case Op::Component: return component();
    case Op::Dot: return dot();
    case Op::Cross: return cross();
    case Op::Contract: return product(ValueKind::Real);
    case Op::Outer: case Op::MatMul: return product(ValueKind::Mat3);
    case Op::MatVec: return matvec();
    case Op::Norm: return norm();
    case Op::Normalize: return normalize();
    case Op::Transpose: case Op::Sym: case Op::Full: case Op::Trace: case Op::Diagonal:
      return linear();
    case Op::Select: return select();
    case Op::And: case Op::Or: case Op::Not: return logic();
    case Op::Less: case Op::LessEqual: case Op::Equal: return comparison();
    case Op::AsReal:
      return is(a_, Op::Constant) ? Result(graph_.constant(value(a_))) : std::nullopt;
    case Op::Frozen: return is(a_, Op::Constant) ? Result(a_) : std::nullopt;
    default: return elementary();
  }
}

NodeId Simplifier::times(double r, NodeId x) {
  return make(node(x).type == ValueKind::Real ? Op::Mul : Op::Scale, graph_.constant(r), x);
}

std::optional<NodeId> Simplifier::ordered() {
  if (index(a_) > index(b_)) return plain(b_, a_);
  return std::nullopt;
}

// ---- sums ---------------------------------------------------------------------------------------

std::optional<NodeId> Simplifier::add() {
  if (graph_.is_zero(a_)) return b_;
  if (graph_.is_zero(b_)) return a_;
  if (number(a_) && number(b_)) return graph_.constant(value(a_) + value(b_));
  if (a_ == b_) return times(2, a_);
  if (is(a_, Op::Neg) && is(b_, Op::Neg)) return negated(make(Op::Add, inner(a_), inner(b_)));
  if (is(b_, Op::Neg)) return make(Op::Sub, a_, inner(b_));
  if (is(a_, Op::Neg)) return make(Op::Sub, b_, inner(a_));
  return ordered();
}

std::optional<NodeId> Simplifier::sub() {
  if (graph_.is_zero(b_)) return a_;
  if (graph_.is_zero(a_)) return negated(b_);
  if (a_ == b_) return zero(node(a_).type);
  if (number(a_) && number(b_)) return graph_.constant(value(a_) - value(b_));
  if (is(a_, Op::Neg) && is(b_, Op::Neg)) return make(Op::Sub, inner(b_), inner(a_));
  if (is(b_, Op::Neg)) return make(Op::Add, a_, inner(b_));
  if (is(a_, Op::Neg)) return negated(make(Op::Add, inner(a_), b_));
  return std::nullopt;
}

std::optional<NodeId> Simplifier::neg() {
  if (graph_.is_zero(a_)) return a_;
  if (number(a_)) return graph_.constant(-value(a_));
  if (is(a_, Op::Neg)) return inner(a_);
  if (is(a_, Op::Sub)) return make(Op::Sub, inner(a_, 1), inner(a_, 0));
  return std::nullopt;
}

// ---- branches and conditions --------------------------------------------------------------------

std::optional<NodeId> Simplifier::select() {
  if (is(a_, Op::Constant)) return value(a_) != 0 ? b_ : c_;
  if (b_ == c_) return b_;
  if (is(a_, Op::Not)) return make(Op::Select, inner(a_), c_, b_);
  const bool minus_b = is(b_, Op::Neg) || graph_.is_zero(b_);
  const bool minus_c = is(c_, Op::Neg) || graph_.is_zero(c_);
  if (minus_b && minus_c) return negated(make(Op::Select, a_, negated(b_), negated(c_)));
  return std::nullopt;
}

std::optional<NodeId> Simplifier::logic() {
  const bool constant_a = is(a_, Op::Constant);
  if (op_ == Op::Not) {
    if (constant_a) return graph_.mask(value(a_) == 0);
    if (is(a_, Op::Not)) return inner(a_);
    return std::nullopt;
  }
  const bool dominant = op_ == Op::Or;
  if (constant_a) return (value(a_) != 0) == dominant ? a_ : b_;
  if (is(b_, Op::Constant)) return (value(b_) != 0) == dominant ? b_ : a_;
  if (a_ == b_) return a_;
  return ordered();
}

std::optional<NodeId> Simplifier::comparison() {
  if (is(a_, Op::Constant) && is(b_, Op::Constant)) {
    const double x = value(a_), y = value(b_);
    return graph_.mask(op_ == Op::Less ? x < y : op_ == Op::LessEqual ? x <= y : x == y);
  }
  return op_ == Op::Equal ? ordered() : std::nullopt;
}

// ---- functions of numbers -----------------------------------------------------------------------

std::optional<NodeId> Simplifier::pow() {
  if (!number(b_)) return std::nullopt;
  const double exponent = value(b_);
  if (exponent == 0.5) return make(Op::Sqrt, a_);
  if (equals(a_, 1)) return a_;
  if (!is_small_whole(exponent)) return std::nullopt;
  if (number(a_)) return graph_.constant(whole_power(value(a_), exponent));
  if (exponent < 0)
    return make(Op::Div, graph_.constant(1), make(Op::Pow, a_, graph_.constant(-exponent)));
  NodeId result = graph_.constant(1);
  NodeId square = a_;
  for (auto bits = static_cast<unsigned>(exponent); bits != 0; bits >>= 1u) {
    if ((bits & 1u) != 0) result = make(Op::Mul, result, square);
    if (bits > 1) square = make(Op::Mul, square, square);
  }
  return result;
}

/// Functions of one or two numbers that are known and that every machine computes alike.
std::optional<NodeId> Simplifier::elementary() {
  if ((op_ == Op::Min || op_ == Op::Max) && a_ == b_) return a_;
  if (op_ == Op::Abs && is(a_, Op::Neg)) return make(Op::Abs, inner(a_));
  if (op_ == Op::Sign && is(a_, Op::Neg)) return negated(make(Op::Sign, inner(a_)));
  if (!number(a_) || (operand_count(op_) == 2 && !number(b_))) return std::nullopt;
  const double x = value(a_);
  const double y = operand_count(op_) == 2 ? value(b_) : 0;
  switch (op_) {
    case Op::Sqrt: return x >= 0 ? Result(graph_.constant(std::sqrt(x))) : std::nullopt;
    case Op::Abs: return graph_.constant(std::abs(x));
    case Op::Sign: return graph_.constant(x > 0 ? 1 : x < 0 ? -1 : 0);
    case Op::Min: return graph_.constant(y < x ? y : x);
    case Op::Max: return graph_.constant(x < y ? y : x);
    case Op::Floor: return graph_.constant(std::floor(x));
    case Op::Ceil: return graph_.constant(std::ceil(x));
    default: return std::nullopt;
  }
}

}  // namespace gmsim::compile::ir
