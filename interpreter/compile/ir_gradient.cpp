// SPDX-License-Identifier: MIT
#include <algorithm>
#include <vector>

#include "compile/ir.h"
#include "compile/ir_builder.h"
#include "compile/ir_scalar_derivative.h"
#include "support/check.h"

namespace gmsim::compile::ir {
namespace {

/// Reverse accumulation from one number. The adjoint of a node is d y / d node, of the node's type;
/// for a symmetric matrix S it is the symmetric G with dy = G : dS.
class Reverse {
 public:
  Reverse(Graph& graph, NodeId y, std::span<const NodeId> inputs)
      : graph_(graph),
        adjoints_(index(y) + 1, kNone),
        leaf_(index(y) + 1, false),
        depends_(index(y) + 1, false) {
    for (const NodeId input : inputs)
      if (index(input) <= index(y)) leaf_[index(input)] = depends_[index(input)] = true;
    for (std::uint32_t i = 0; i <= index(y); ++i) {
      const Node& node = graph_[NodeId{i}];
      if (is_barrier(node.op)) continue;
      for (const NodeId operand : node.operands)
        if (operand != kNone && depends_[index(operand)]) depends_[i] = true;
    }
    if (depends_[index(y)]) adjoints_[index(y)] = graph.constant(1);
  }

  void run() {
    for (auto i = static_cast<std::uint32_t>(adjoints_.size()); i-- > 0;) {
      if (!leaf_[i] && adjoints_[i] != kNone && !graph_.is_zero(adjoints_[i]))
        visit(NodeId{i}, adjoints_[i]);
    }
  }

  NodeId of(NodeId input) {
    const bool reached = index(input) < adjoints_.size() && adjoints_[index(input)] != kNone;
    return reached ? adjoints_[index(input)] : graph_.zero(graph_[input].type);
  }

 private:
  void pass(NodeId operand, NodeId part) {
    if (!depends_[index(operand)]) return;
    NodeId& adjoint = adjoints_[index(operand)];
    adjoint = adjoint == kNone ? part : graph_.make(Op::Add, adjoint, part);
  }

  void visit(NodeId y, NodeId g) {
    const Node node = graph_[y];
    Builder make(graph_, node.span);
    if (visit_scalars(y, node, g, make) || visit_linear(y, node, g, make) ||
        visit_vectors(y, node, g, make))
      return;
    visit_matrices(y, node, g, make);
  }

  bool visit_scalars(NodeId y, const Node& node, NodeId g, Builder& make) {
    for (int k = 0; k < operand_count(node.op); ++k) {
      if (node.type == ValueKind::Real && !depends_[index(node.operands[k])]) continue;
      const auto slope = scalar_derivative(graph_, make, y, k);
      if (!slope) return false;
      pass(node.operands[k], make.mul(g, *slope));
    }
    return true;
  }

  bool visit_linear(NodeId y, const Node& node, NodeId g, Builder& make) {
    const auto [a, b, c] = node.operands;
    switch (node.op) {
      case Op::Add: pass(a, g); pass(b, g); return true;
      case Op::Sub: pass(a, g); pass(b, make.neg(g)); return true;
      case Op::Neg: pass(a, make.neg(g)); return true;
      case Op::Div:
        pass(a, make.div(g, b));
        pass(b, make.neg(make.div(make.inner(g, y), b)));
        return true;
      case Op::Scale: pass(a, make.inner(g, b)); pass(b, make.scale(a, g)); return true;
      case Op::Select: {
        const NodeId none = make.zero(node.type);
        pass(b, make.select(a, g, none));
        pass(c, make.select(a, none, g));
        return true;
      }
      case Op::Vector:
        for (std::uint32_t k = 0; k < 3; ++k) pass(node.operands[k], make.component(g, k));
        return true;
      case Op::Component: pass(a, single_entry(a, node.aux, g, make)); return true;
      default: return false;
    }
  }

  /// The value of the type of `x` whose inner product with dx is g times entry `which` of dx.
  NodeId single_entry(NodeId x, std::uint32_t which, NodeId g, Builder& make) {
    if (graph_[x].type == ValueKind::Vec3) return make.scale(g, make.axis(static_cast<int>(which)));
    static constexpr int kRows[] = {0, 1, 2, 1, 0, 0};     // of Sym3: xx yy zz yz xz xy
    static constexpr int kColumns[] = {0, 1, 2, 2, 2, 1};
    const bool symmetric = graph_[x].type == ValueKind::Sym3;
    const int row = symmetric ? kRows[which] : static_cast<int>(which) / 3;
    const int column = symmetric ? kColumns[which] : static_cast<int>(which) % 3;
    const NodeId entry = make.make(Op::Outer, make.scale(g, make.axis(row)), make.axis(column));
    return make.in_type_of(entry, x);
  }

  bool visit_vectors(NodeId y, const Node& node, NodeId g, Builder& make) {
    const auto [a, b, c] = node.operands;
    switch (node.op) {
      case Op::Dot: case Op::Contract: pass(a, make.scale(g, b)); pass(b, make.scale(g, a)); return true;
      case Op::Cross: pass(a, make.make(Op::Cross, b, g)); pass(b, make.make(Op::Cross, g, a)); return true;
      case Op::Norm: pass(a, make.scale(g, make.make(Op::Normalize, a))); return true;
      case Op::Normalize: {
        const NodeId length = make.make(Op::Norm, a);
        const NodeId across = make.sub(g, make.scale(make.inner(y, g), y));
        const NodeId value = make.scale(make.div(make.number(1), length), across);
        pass(a, make.select(make.less(make.number(0), length), value, make.zero(ValueKind::Vec3)));
        return true;
      }
      case Op::Outer: pass(a, make.matvec(g, b)); pass(b, make.matvec(make.transpose(g), a)); return true;
      case Op::MatVec:
        pass(a, make.in_type_of(make.make(Op::Outer, g, b), a));
        pass(b, make.matvec(make.transpose(a), g));
        return true;
      case Op::Columns:
        for (int k = 0; k < 3; ++k) pass(node.operands[k], make.column(g, k));
        return true;
      case Op::Diagonal:
        pass(a, make.make(Op::Vector, make.component(g, 0), make.component(g, 1), make.component(g, 2)));
        return true;
      default: return false;
    }
  }

  void visit_matrices(NodeId y, const Node& node, NodeId g, Builder& make) {
    const NodeId a = node.operands[0], b = node.operands[1];
    switch (node.op) {
      case Op::MatMul:
        pass(a, make.matmul(g, make.transpose(b)));
        pass(b, make.matmul(make.transpose(a), g));
        return;
      case Op::Transpose: pass(a, make.transpose(g)); return;
      case Op::Sym: pass(a, make.full(g)); return;
      case Op::Full: pass(a, make.sym(g)); return;
      case Op::Trace: pass(a, make.in_type_of(make.multiple_of_identity(g), a)); return;
      case Op::Det: pass(a, make.scale(g, make.in_type_of(make.cofactor(a), a))); return;
      case Op::Inverse: {
        const NodeId turned = make.transpose(make.full(y));
        const NodeId product = make.matmul(make.matmul(turned, make.full(g)), turned);
        pass(a, make.neg(make.in_type_of(product, a)));
        return;
      }
      case Op::Polar: {  // numerics: (tr(S) I - S) w = axial(R^T dF), dR = R [w]x
        const NodeId metric = make.make(Op::Inverse, make.polar_metric(y, a));
        const NodeId axis = make.matvec(metric, make.axial(make.matmul(make.transpose(y), g)));
        pass(a, make.matmul(y, make.cross_matrix(axis)));
        return;
      }
      case Op::MaxEigenvalue: case Op::MinEigenvalue: {
        const Op vector = node.op == Op::MaxEigenvalue ? Op::MaxEigenvector : Op::MinEigenvector;
        const NodeId q = make.make(vector, a);
        pass(a, make.scale(g, make.sym(make.make(Op::Outer, q, q))));
        return;
      }
      default: GMSIM_CHECK(false, "no derivative for this operation");
    }
  }

  Graph& graph_;
  std::vector<NodeId> adjoints_;
  std::vector<bool> leaf_;     // is one of the inputs: nothing behind it is differentiated
  std::vector<bool> depends_;  // on one of the inputs; the others need no adjoint
};

}  // namespace

std::vector<NodeId> gradient(Graph& graph, NodeId y, std::span<const NodeId> inputs) {
  Reverse reverse(graph, y, inputs);
  reverse.run();
  std::vector<NodeId> result;
  for (const NodeId input : inputs) result.push_back(reverse.of(input));
  return result;
}

}  // namespace gmsim::compile::ir
