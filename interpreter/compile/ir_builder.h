// SPDX-License-Identifier: MIT
#pragma once

#include "compile/ir.h"

namespace gmsim::compile::ir {

/// Short names for making nodes, used where derivatives are written down.
class Builder {
 public:
  Builder(Graph& graph, Span span) : graph_(graph), span_(span) {}

  NodeId make(Op op, NodeId a, NodeId b = kNone, NodeId c = kNone, std::uint32_t aux = 0) {
    return graph_.make(op, a, b, c, aux, span_);
  }
  NodeId number(double value) { return graph_.constant(value); }
  NodeId zero(ValueKind type) { return graph_.zero(type); }
  NodeId add(NodeId a, NodeId b) { return make(Op::Add, a, b); }
  NodeId sub(NodeId a, NodeId b) { return make(Op::Sub, a, b); }
  NodeId neg(NodeId a) { return make(Op::Neg, a); }
  NodeId mul(NodeId a, NodeId b) { return make(Op::Mul, a, b); }
  NodeId div(NodeId a, NodeId b) { return make(Op::Div, a, b); }
  /// r * X for X of any type.
  NodeId scale(NodeId r, NodeId x) {
    return graph_[x].type == ValueKind::Real ? mul(r, x) : make(Op::Scale, r, x);
  }
  NodeId select(NodeId mask, NodeId a, NodeId b) { return make(Op::Select, mask, a, b); }
  NodeId component(NodeId x, std::uint32_t which) {
    return make(Op::Component, x, kNone, kNone, which);
  }
  NodeId matvec(NodeId m, NodeId v) { return make(Op::MatVec, m, v); }
  NodeId matmul(NodeId a, NodeId b) { return make(Op::MatMul, a, b); }
  NodeId transpose(NodeId m) {
    return graph_[m].type == ValueKind::Mat3 ? make(Op::Transpose, m) : m;
  }
  NodeId full(NodeId m) { return graph_[m].type == ValueKind::Sym3 ? make(Op::Full, m) : m; }
  NodeId sym(NodeId m) { return graph_[m].type == ValueKind::Mat3 ? make(Op::Sym, m) : m; }
  /// `m` in the type of `like`: a full matrix, or its symmetric part.
  NodeId in_type_of(NodeId m, NodeId like) {
    return graph_[like].type == ValueKind::Sym3 ? sym(m) : full(m);
  }
  /// The sum of all products of entries of two values of one type.
  NodeId inner(NodeId a, NodeId b) {
    switch (graph_[a].type) {
      case ValueKind::Real: return mul(a, b);
      case ValueKind::Vec3: return make(Op::Dot, a, b);
      default: return make(Op::Contract, a, b);
    }
  }
  NodeId axis(int k) {
    return make(Op::Vector, number(k == 0), number(k == 1), number(k == 2));
  }
  NodeId column(NodeId m, int k) { return matvec(m, axis(k)); }
  NodeId columns(NodeId a, NodeId b, NodeId c) { return make(Op::Columns, a, b, c); }
  /// r times the identity, Sym3.
  NodeId multiple_of_identity(NodeId r) {
    return make(Op::Diagonal, make(Op::Vector, r, r, r));
  }
  /// The matrix of w x ., Mat3.
  NodeId cross_matrix(NodeId w) {
    return columns(make(Op::Cross, w, axis(0)), make(Op::Cross, w, axis(1)),
                   make(Op::Cross, w, axis(2)));
  }
  /// (A32 - A23, A13 - A31, A21 - A12): A : [w]x = w . axial(A).
  NodeId axial(NodeId a) {
    return make(Op::Vector, sub(component(a, 7), component(a, 5)),
                sub(component(a, 2), component(a, 6)), sub(component(a, 3), component(a, 1)));
  }
  /// The derivative of det: columns b x c, c x a, a x b of a matrix with columns a, b, c.
  NodeId cofactor(NodeId m) {
    const NodeId a = column(m, 0), b = column(m, 1), c = column(m, 2);
    return columns(make(Op::Cross, b, c), make(Op::Cross, c, a), make(Op::Cross, a, b));
  }
  /// tr(S) I - S with S = R^T F: what turns the axis of a change of F into that of R.
  NodeId polar_metric(NodeId r, NodeId f) {
    const NodeId stretch = sym(matmul(transpose(r), f));
    return sub(multiple_of_identity(make(Op::Trace, stretch)), stretch);
  }
  NodeId less(NodeId a, NodeId b) { return make(Op::Less, a, b); }

 private:
  Graph& graph_;
  Span span_;
};

}  // namespace gmsim::compile::ir
