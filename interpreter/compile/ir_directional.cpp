// SPDX-License-Identifier: MIT
#include <algorithm>
#include <unordered_map>
#include <vector>

#include "compile/ir.h"
#include "compile/ir_builder.h"
#include "compile/ir_scalar_derivative.h"
#include "support/check.h"

namespace gmsim::compile::ir {
namespace {

/// Forward accumulation: the tangent of a node is its change along the given direction.
class Forward {
 public:
  explicit Forward(Graph& graph) : graph_(graph) {}

  void seed(NodeId input, NodeId tangent) { tangents_[index(input)] = tangent; }

  NodeId tangent(NodeId id) {
    if (const auto known = tangents_.find(index(id)); known != tangents_.end())
      return known->second;
    const NodeId value = derive(id);
    tangents_[index(id)] = value;
    return value;
  }

 private:
  NodeId derive(NodeId y) {
    const Node node = graph_[y];
    Builder make(graph_, node.span);
    if (operand_count(node.op) == 0 || is_barrier(node.op)) return make.zero(node.type);
    if (scalar_derivative(graph_, make, y, 0)) return derive_scalar(y, node, make);
    if (node.op == Op::Select)
      return make.select(node.operands[0], tangent(node.operands[1]), tangent(node.operands[2]));
    const NodeId da = tangent(node.operands[0]);
    const NodeId db = operand_count(node.op) > 1 ? tangent(node.operands[1]) : kNone;
    const NodeId dc = operand_count(node.op) > 2 ? tangent(node.operands[2]) : kNone;
    return derive_tensor(y, node, da, db, dc, make);
  }

  NodeId derive_scalar(NodeId y, const Node& node, Builder& make) {
    NodeId sum = make.number(0);
    for (int k = 0; k < operand_count(node.op); ++k) {
      const NodeId dk = tangent(node.operands[k]);
      if (!graph_.is_zero(dk)) sum = make.add(sum, make.mul(*scalar_derivative(graph_, make, y, k), dk));
    }
    return sum;
  }

  NodeId derive_tensor(NodeId y, const Node& node, NodeId da, NodeId db, NodeId dc, Builder& make) {
    const NodeId a = node.operands[0], b = node.operands[1];
    switch (node.op) {
      case Op::Add: case Op::Sub: case Op::Neg: case Op::Vector: case Op::Columns:
      case Op::Component: case Op::Transpose: case Op::Sym: case Op::Full: case Op::Trace:
      case Op::Diagonal:
        return make.make(node.op, da, db, dc, node.aux);
      case Op::Div: return make.div(make.sub(da, make.scale(db, y)), b);
      case Op::Scale: return make.add(make.scale(da, b), make.scale(a, db));
      case Op::Dot: case Op::Contract: case Op::Cross: case Op::Outer: case Op::MatVec: case Op::MatMul:
        return make.add(make.make(node.op, da, b), make.make(node.op, a, db));
      case Op::Norm: return make.inner(make.make(Op::Normalize, a), da);
      case Op::Normalize: {
        const NodeId length = make.make(Op::Norm, a);
        const NodeId across = make.sub(da, make.scale(make.inner(y, da), y));
        const NodeId value = make.scale(make.div(make.number(1), length), across);
        return make.select(make.less(make.number(0), length), value, make.zero(ValueKind::Vec3));
      }
      case Op::Det: return make.inner(make.cofactor(a), make.full(da));
      case Op::Inverse: {
        const NodeId product = make.matmul(make.matmul(make.full(y), make.full(da)), make.full(y));
        return make.neg(make.in_type_of(product, a));
      }
      case Op::Polar: {
        const NodeId metric = make.make(Op::Inverse, make.polar_metric(y, a));
        const NodeId axis = make.matvec(metric, make.axial(make.matmul(make.transpose(y), da)));
        return make.matmul(y, make.cross_matrix(axis));
      }
      case Op::MaxEigenvalue: case Op::MinEigenvalue: {
        const Op vector = node.op == Op::MaxEigenvalue ? Op::MaxEigenvector : Op::MinEigenvector;
        const NodeId q = make.make(vector, a);
        return make.inner(q, make.matvec(da, q));
      }
      default: GMSIM_CHECK(false, "no derivative for this operation");
    }
    return kNone;
  }

  Graph& graph_;
  std::unordered_map<std::uint32_t, NodeId> tangents_;
};

}  // namespace

NodeId directional(Graph& graph, NodeId y, std::span<const NodeId> inputs,
                   std::span<const NodeId> seeds) {
  GMSIM_CHECK(inputs.size() == seeds.size(), "one seed for each input");
  Forward forward(graph);
  for (std::size_t k = 0; k < inputs.size(); ++k) forward.seed(inputs[k], seeds[k]);
  return forward.tangent(y);
}

}  // namespace gmsim::compile::ir
