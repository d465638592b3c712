// SPDX-License-Identifier: MIT
#include "compile/ir_scalar_derivative.h"

namespace gmsim::compile::ir {
namespace {

/// a^b: b a^(b-1), and log(a) a^b for an exponent that varies.
NodeId power_derivative(Builder& make, NodeId y, NodeId a, NodeId b, int operand) {
  if (operand == 1) return make.mul(y, make.make(Op::Log, a));
  return make.mul(b, make.make(Op::Pow, a, make.sub(b, make.number(1))));
}

/// The angle of (b, a): zero where both are zero, as for the derivative of a norm.
NodeId angle_derivative(Builder& make, NodeId a, NodeId b, int operand) {
  const NodeId square = make.add(make.mul(a, a), make.mul(b, b));
  const NodeId value = operand == 0 ? make.div(b, square) : make.neg(make.div(a, square));
  return make.select(make.less(make.number(0), square), value, make.number(0));
}

}  // namespace

bool is_barrier(Op op) {
  switch (op) {
    case Op::Frozen: case Op::AsReal: case Op::MaxEigenvector: case Op::MinEigenvector:
    case Op::Less: case Op::LessEqual: case Op::Equal: case Op::And: case Op::Or: case Op::Not:
      return true;
    default: return false;
  }
}

std::optional<NodeId> scalar_derivative(const Graph& graph, Builder& make, NodeId y, int operand) {
  const Node node = graph[y];
  const NodeId a = node.operands[0], b = node.operands[1];
  const NodeId one = make.number(1);
  switch (node.op) {
    case Op::Mul: return operand == 0 ? b : a;
    case Op::Div:
      if (node.type != ValueKind::Real) return std::nullopt;
      return operand == 0 ? make.div(one, b) : make.neg(make.div(y, b));
    case Op::Pow: return power_derivative(make, y, a, b, operand);
    case Op::Sqrt: return make.div(make.number(0.5), y);
    case Op::Abs: return make.make(Op::Sign, a);
    case Op::Min: case Op::Max: {
      const NodeId second_wins = node.op == Op::Min ? make.less(b, a) : make.less(a, b);
      return make.make(Op::AsReal, operand == 1 ? second_wins : make.make(Op::Not, second_wins));
    }
    case Op::Mod:
      return operand == 0 ? one : make.neg(make.make(Op::Floor, make.div(a, b)));
    case Op::Exp: return y;
    case Op::Log: return make.div(one, a);
    case Op::Sin: return make.make(Op::Cos, a);
    case Op::Cos: return make.neg(make.make(Op::Sin, a));
    case Op::Tan: return make.add(one, make.mul(y, y));
    case Op::Asin: return make.div(one, make.make(Op::Sqrt, make.sub(one, make.mul(a, a))));
    case Op::Acos: return make.neg(make.div(one, make.make(Op::Sqrt, make.sub(one, make.mul(a, a)))));
    case Op::Atan: return make.div(one, make.add(one, make.mul(a, a)));
    case Op::Atan2: return angle_derivative(make, a, b, operand);
    case Op::Tanh: return make.sub(one, make.mul(y, y));
    case Op::Sign: case Op::Floor: case Op::Ceil: return make.number(0);
    default: return std::nullopt;
  }
}

}  // namespace gmsim::compile::ir
