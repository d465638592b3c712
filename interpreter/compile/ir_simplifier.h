// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "compile/ir.h"

namespace gmsim::compile::ir {

/// One call of simplify(): the graph and the operands under shorter names. Empty results mean that
/// no rule applies.
class Simplifier {
 public:
  Simplifier(Graph& graph, Op op, NodeId a, NodeId b, NodeId c, std::uint32_t aux, Span span)
      : graph_(graph), op_(op), a_(a), b_(b), c_(c), aux_(aux), span_(span) {}

  [[nodiscard]] std::optional<NodeId> run();

 private:
  using Result = std::optional<NodeId>;

  [[nodiscard]] const Node& node(NodeId id) const { return graph_[id]; }
  [[nodiscard]] bool is(NodeId id, Op op) const { return node(id).op == op; }
  [[nodiscard]] bool number(NodeId id) const {
    return is(id, Op::Constant) && node(id).type == ValueKind::Real;
  }
  [[nodiscard]] double value(NodeId id) const { return node(id).constant; }
  [[nodiscard]] static bool power_of_two(double x);
  [[nodiscard]] bool equals(NodeId id, double x) const { return number(id) && value(id) == x; }
  [[nodiscard]] NodeId inner(NodeId id, int operand = 0) const {
    return node(id).operands[operand];
  }
  [[nodiscard]] NodeId zero(ValueKind type) { return graph_.zero(type); }
  NodeId make(Op op, NodeId a, NodeId b = kNone, NodeId c = kNone, std::uint32_t aux = 0) {
    return graph_.make(op, a, b, c, aux, span_);
  }
  NodeId negated(NodeId id) { return make(Op::Neg, id); }
  NodeId plain(NodeId a, NodeId b) { return graph_.make_plain(op_, a, b, c_, aux_, span_); }
  /// r * x of any type.
  NodeId times(double r, NodeId x);
  /// The operation with its two operands in the order of their making.
  Result ordered();

  // ir_simplify.cpp
  Result add();
  Result sub();
  Result neg();
  Result select();
  Result logic();
  Result comparison();
  Result elementary();
  Result pow();
  // ir_simplify_products.cpp
  Result mul();
  Result div();
  Result scale();
  Result product(ValueKind type);
  Result minus_outwards();
  Result power_of_two_outwards();
  Result branch_outwards();
  [[nodiscard]] bool guards(NodeId id) const;
  // ir_simplify_tensors.cpp
  Result vector();
  Result component();
  Result dot();
  Result cross();
  Result matvec();
  Result norm();
  Result normalize();
  Result linear();
  [[nodiscard]] bool swapped_difference(NodeId id) const;
  [[nodiscard]] std::optional<std::uint32_t> axis(NodeId id) const;

  Graph& graph_;
  Op op_;
  NodeId a_, b_, c_;
  std::uint32_t aux_;
  Span span_;
};

}  // namespace gmsim::compile::ir
