// SPDX-License-Identifier: MIT
#include "compile/ir_simplify.h"

#include <cmath>

namespace gmsim::compile::ir {
namespace {

/// One call of simplify(): the graph and the operands under a shorter name.
class Simplifier {
 public:
  Simplifier(Graph& graph, Op op, NodeId a, NodeId b, NodeId c, std::uint32_t aux, Span span)
      : graph_(graph), op_(op), a_(a), b_(b), c_(c), aux_(aux), span_(span) {}

  std::optional<NodeId> run() {
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
      case Op::Dot: case Op::Contract: return product(ValueKind::Real, true);
      case Op::Cross: return a_ == b_ ? zero(ValueKind::Vec3) : product(ValueKind::Vec3, false);
      case Op::Outer: return product(ValueKind::Mat3, false);
      case Op::MatVec: return product(ValueKind::Vec3, false);
      case Op::MatMul: return product(ValueKind::Mat3, false);
      case Op::Norm: return norm();
      case Op::Normalize: return normalize();
      case Op::Transpose: case Op::Sym: case Op::Full: case Op::Trace: case Op::Diagonal: return linear();
      case Op::Select: return select();
      case Op::And: case Op::Or: case Op::Not: case Op::Less: case Op::LessEqual: case Op::Equal:
        return logic();
      case Op::Frozen: return graph_[a_].op == Op::Constant ? std::optional(a_) : std::nullopt;
      default: return elementary();
    }
  }

 private:
  const Node& node(NodeId id) const { return graph_[id]; }
  bool is(NodeId id, Op op) const { return node(id).op == op; }
  bool number(NodeId id) const {
    return is(id, Op::Constant) && node(id).type == ValueKind::Real;
  }
  bool equals(NodeId id, double value) const { return number(id) && node(id).constant == value; }
  NodeId inner(NodeId id) const { return node(id).operands[0]; }
  std::optional<NodeId> zero(ValueKind type) { return graph_.zero(type); }
  NodeId make(Op op, NodeId a, NodeId b = kNone) { return graph_.make(op, a, b, kNone, 0, span_); }
  NodeId negated(NodeId id) { return make(Op::Neg, id); }
  std::optional<NodeId> plain(NodeId a, NodeId b) {
    return graph_.make_plain(op_, a, b, c_, aux_, span_);
  }

  std::optional<NodeId> add() {
    if (graph_.is_zero(a_)) return b_;
    if (graph_.is_zero(b_)) return a_;
    if (number(a_) && number(b_)) return graph_.constant(node(a_).constant + node(b_).constant);
    if (is(b_, Op::Neg)) return make(Op::Sub, a_, inner(b_));
    if (is(a_, Op::Neg)) return make(Op::Sub, b_, inner(a_));
    if (index(a_) > index(b_)) return plain(b_, a_);
    return std::nullopt;
  }

  std::optional<NodeId> sub() {
    if (graph_.is_zero(b_)) return a_;
    if (graph_.is_zero(a_)) return negated(b_);
    if (a_ == b_) return zero(node(a_).type);
    if (number(a_) && number(b_)) return graph_.constant(node(a_).constant - node(b_).constant);
    if (is(b_, Op::Neg)) return make(Op::Add, a_, inner(b_));
    return std::nullopt;
  }

  std::optional<NodeId> neg() {
    if (graph_.is_zero(a_)) return a_;
    if (number(a_)) return graph_.constant(-node(a_).constant);
    if (is(a_, Op::Neg)) return inner(a_);
    if (is(a_, Op::Sub)) return make(Op::Sub, node(a_).operands[1], node(a_).operands[0]);
    return std::nullopt;
  }

  std::optional<NodeId> mul() {
    if (graph_.is_zero(a_) || graph_.is_zero(b_)) return zero(ValueKind::Real);
    if (number(a_) && number(b_)) return graph_.constant(node(a_).constant * node(b_).constant);
    if (equals(a_, 1)) return b_;
    if (equals(b_, 1)) return a_;
    if (equals(a_, -1)) return negated(b_);
    if (equals(b_, -1)) return negated(a_);
    if (const auto outside = move_minus_out()) return outside;
    if (index(a_) > index(b_)) return plain(b_, a_);
    return std::nullopt;
  }

  std::optional<NodeId> div() {
    if (graph_.is_zero(a_) && !graph_.is_zero(b_)) return a_;
    if (equals(b_, 1)) return a_;
    if (number(a_) && number(b_) && node(b_).constant != 0)
      return graph_.constant(node(a_).constant / node(b_).constant);
    return move_minus_out();
  }

  std::optional<NodeId> scale() {
    if (graph_.is_zero(a_) || graph_.is_zero(b_)) return zero(node(b_).type);
    if (equals(a_, 1)) return b_;
    if (equals(a_, -1)) return negated(b_);
    return move_minus_out();
  }

  /// (-a) op b = a op (-b) = -(a op b) for products.
  std::optional<NodeId> move_minus_out() {
    if (is(a_, Op::Neg)) return negated(make(op_, inner(a_), b_));
    if (is(b_, Op::Neg)) return negated(make(op_, a_, inner(b_)));
    return std::nullopt;
  }

  /// Small whole exponents are products, so that a square costs one multiplication everywhere.
  std::optional<NodeId> pow() {
    if (!number(b_)) return std::nullopt;
    const double exponent = node(b_).constant;
    if (number(a_)) return graph_.constant(std::pow(node(a_).constant, exponent));
    if (exponent == 0) return graph_.constant(1);
    if (exponent == 1) return a_;
    if (exponent == 0.5) return make(Op::Sqrt, a_);
    if (exponent < 0 && exponent >= -4 && exponent == std::floor(exponent))
      return make(Op::Div, graph_.constant(1), make(Op::Pow, a_, graph_.constant(-exponent)));
    if (exponent > 0 && exponent <= 4 && exponent == std::floor(exponent)) {
      const NodeId square = make(Op::Mul, a_, a_);
      if (exponent == 2) return square;
      return make(Op::Mul, square, exponent == 3 ? a_ : square);
    }
    return std::nullopt;
  }

  std::optional<NodeId> vector() {
    if (graph_.is_zero(a_) && graph_.is_zero(b_) && graph_.is_zero(c_))
      return zero(ValueKind::Vec3);
    return std::nullopt;
  }

  std::optional<NodeId> component() {
    if (graph_.is_zero(a_)) return zero(ValueKind::Real);
    if (is(a_, Op::Vector)) return node(a_).operands[aux_];
    if (is(a_, Op::Neg)) return negated(graph_.make(op_, inner(a_), kNone, kNone, aux_, span_));
    return std::nullopt;
  }

  std::optional<NodeId> product(ValueKind type, bool commutes) {
    if (graph_.is_zero(a_) || graph_.is_zero(b_)) return zero(type);
    if (const auto outside = move_minus_out()) return outside;
    if (commutes && index(a_) > index(b_)) return plain(b_, a_);
    return std::nullopt;
  }

  std::optional<NodeId> norm() {
    if (graph_.is_zero(a_)) return zero(ValueKind::Real);
    if (is(a_, Op::Neg)) return make(op_, inner(a_));
    if (swapped_difference()) return make(op_, negated(a_));
    return std::nullopt;
  }

  std::optional<NodeId> normalize() {
    if (graph_.is_zero(a_)) return a_;
    if (is(a_, Op::Neg)) return negated(make(op_, inner(a_)));
    if (swapped_difference()) return negated(make(op_, negated(a_)));
    return std::nullopt;
  }

  /// x - y with x made after y: its length is taken of y - x, so both ways share one node.
  bool swapped_difference() const {
    return is(a_, Op::Sub) && index(node(a_).operands[0]) > index(node(a_).operands[1]);
  }

  std::optional<NodeId> linear() {
    if (graph_.is_zero(a_)) {
      if (op_ == Op::Trace) return zero(ValueKind::Real);
      return zero(op_ == Op::Transpose || op_ == Op::Full ? ValueKind::Mat3 : ValueKind::Sym3);
    }
    if (is(a_, Op::Neg)) return negated(make(op_, inner(a_)));
    if (op_ == Op::Transpose && is(a_, Op::Transpose)) return inner(a_);
    if (op_ == Op::Sym && is(a_, Op::Full)) return inner(a_);
    return std::nullopt;
  }

  std::optional<NodeId> select() {
    if (is(a_, Op::Constant)) return node(a_).constant != 0 ? b_ : c_;
    if (b_ == c_) return b_;
    return std::nullopt;
  }

  std::optional<NodeId> logic() {
    const bool constant_a = is(a_, Op::Constant);
    if (op_ == Op::Not) {
      if (constant_a) return graph_.mask(node(a_).constant == 0);
      if (is(a_, Op::Not)) return inner(a_);
      return std::nullopt;
    }
    const bool constant_b = is(b_, Op::Constant);
    if (op_ == Op::And || op_ == Op::Or) {
      const bool dominant = op_ == Op::Or;
      if (constant_a) return (node(a_).constant != 0) == dominant ? a_ : b_;
      if (constant_b) return (node(b_).constant != 0) == dominant ? b_ : a_;
      return std::nullopt;
    }
    if (!constant_a || !constant_b) return std::nullopt;
    const double x = node(a_).constant, y = node(b_).constant;
    return graph_.mask(op_ == Op::Less ? x < y : op_ == Op::LessEqual ? x <= y : x == y);
  }

  /// Functions of one or two numbers that are known.
  std::optional<NodeId> elementary() {
    if (!number(a_) || (operand_count(op_) == 2 && !number(b_))) return std::nullopt;
    const double x = node(a_).constant;
    const double y = operand_count(op_) == 2 ? node(b_).constant : 0;
    switch (op_) {
      case Op::Sqrt: return x >= 0 ? std::optional(graph_.constant(std::sqrt(x))) : std::nullopt;
      case Op::Abs: return graph_.constant(std::abs(x));
      case Op::Sign: return graph_.constant(x > 0 ? 1 : x < 0 ? -1 : 0);
      case Op::Min: return graph_.constant(y < x ? y : x);
      case Op::Max: return graph_.constant(x < y ? y : x);
      case Op::Floor: return graph_.constant(std::floor(x));
      case Op::Ceil: return graph_.constant(std::ceil(x));
      default: return std::nullopt;
    }
  }

  Graph& graph_;
  Op op_;
  NodeId a_, b_, c_;
  std::uint32_t aux_;
  Span span_;
};

}  // namespace

std::optional<NodeId> simplify(Graph& graph, Op op, NodeId a, NodeId b, NodeId c,
                               std::uint32_t aux, Span span) {
  return Simplifier(graph, op, a, b, c, aux, span).run();
}

}  // namespace gmsim::compile::ir
