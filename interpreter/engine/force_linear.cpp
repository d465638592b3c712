// SPDX-License-Identifier: MIT
#include "engine/force_linear.h"

#include <map>
#include <utility>

namespace gmsim::engine {

namespace ir = compile::ir;
using ir::NodeId;
using ir::Op;

namespace {

/// How a node depends on the summed inputs.
enum class Degree : std::uint8_t { Zero, Constant, Linear, Other };

bool none(Degree d) { return d <= Degree::Constant; }

/// Of a sum, or a choice between two.
Degree joined(Degree a, Degree b) {
  if (a == Degree::Zero) return b;
  return b == Degree::Zero || a == b ? a : Degree::Other;
}

Degree product(Degree a, Degree b) {
  if (a == Degree::Zero || b == Degree::Zero) return Degree::Zero;
  if (none(a)) return b;
  return none(b) ? a : Degree::Other;
}

Degree degree_of(const ir::Graph& graph, NodeId id, const std::vector<bool>& summed,
                 const std::vector<Degree>& degrees) {
  const ir::Node& node = graph[id];
  const auto of = [&](int k) { return degrees[ir::index(node.operands[k])]; };
  switch (node.op) {
    case Op::Input: return summed[node.aux] ? Degree::Linear : Degree::Constant;
    case Op::Constant: return graph.is_zero(id) ? Degree::Zero : Degree::Constant;
    case Op::Neg: case Op::Component: case Op::Transpose: case Op::Trace: case Op::Sym:
    case Op::Full: case Op::Diagonal: case Op::Frozen:
      return of(0);
    case Op::Add: case Op::Sub: return joined(of(0), of(1));
    case Op::Vector: case Op::Columns: return joined(joined(of(0), of(1)), of(2));
    case Op::Select: return none(of(0)) ? joined(of(1), of(2)) : Degree::Other;
    case Op::Mul: case Op::Scale: case Op::Dot: case Op::Cross: case Op::Outer: case Op::MatVec:
    case Op::MatMul: case Op::Contract:
      return product(of(0), of(1));
    case Op::Div: return none(of(1)) ? of(0) : Degree::Other;
    default:
      for (int k = 0; k < ir::operand_count(node.op); ++k)
        if (!none(of(k))) return Degree::Other;
      return Degree::Constant;
  }
}

/// Compares a node with the exchanged form of another, up to the sign.
class Exchange {
 public:
  Exchange(const ir::Graph& graph, const std::vector<std::uint32_t>& partner)
      : graph_(graph), partner_(partner) {}

  /// s with exchanged(a) = s b; 0 when no sign is known to do.
  int sign(NodeId a, NodeId b) {
    const auto [known, fresh] = known_.try_emplace({ir::index(a), ir::index(b)}, 0);
    if (!fresh) return known->second;
    const int result = compare(graph_[a], graph_[b]);
    known_[{ir::index(a), ir::index(b)}] = result;
    return result;
  }

 private:
  int compare(const ir::Node& a, const ir::Node& b) {
    if (a.op == Op::Neg) return -sign(a.operands[0], id_of(b));
    if (b.op == Op::Neg) return -sign(id_of(a), b.operands[0]);
    if (a.op != b.op || a.type != b.type) return 0;
    const NodeId a0 = a.operands[0], a1 = a.operands[1], b0 = b.operands[0], b1 = b.operands[1];
    switch (a.op) {
      case Op::Constant: return a.constant == b.constant ? 1 : a.constant == -b.constant ? -1 : 0;
      case Op::Input: return partner_[a.aux] == b.aux ? 1 : 0;
      case Op::Add: {
        const int straight = both(a0, b0, a1, b1);
        return straight != 0 ? straight : both(a0, b1, a1, b0);
      }
      case Op::Sub: {
        const int straight = both(a0, b0, a1, b1);
        return straight != 0 ? straight : -both(a0, b1, a1, b0);
      }
      case Op::Mul: case Op::Dot: case Op::Contract: {
        const int straight = sign(a0, b0) * sign(a1, b1);
        return straight != 0 ? straight : sign(a0, b1) * sign(a1, b0);
      }
      case Op::Cross: {
        const int straight = sign(a0, b0) * sign(a1, b1);
        return straight != 0 ? straight : -sign(a0, b1) * sign(a1, b0);
      }
      case Op::Scale: case Op::Div: case Op::Outer: case Op::MatVec: case Op::MatMul:
        return sign(a0, b0) * sign(a1, b1);
      case Op::Norm: case Op::Abs: return sign(a0, b0) != 0 ? 1 : 0;
      case Op::Normalize: case Op::Frozen: case Op::Transpose: case Op::Trace: return sign(a0, b0);
      case Op::Component: return a.aux == b.aux ? sign(a0, b0) : 0;
      case Op::Select: return sign(a0, b0) == 1 ? both(a1, b1, a.operands[2], b.operands[2]) : 0;
      default: return all_equal(a, b) ? 1 : 0;
    }
  }
  /// The sign that both pairs have.
  int both(NodeId a, NodeId b, NodeId c, NodeId d) {
    const int first = sign(a, b);
    return first != 0 && sign(c, d) == first ? first : 0;
  }
  bool all_equal(const ir::Node& a, const ir::Node& b) {
    if (a.aux != b.aux || a.constant != b.constant) return false;
    for (int k = 0; k < ir::operand_count(a.op); ++k)
      if (sign(a.operands[k], b.operands[k]) != 1) return false;
    return true;
  }
  /// Nodes are looked at in place, so their number is where they stand.
  [[nodiscard]] NodeId id_of(const ir::Node& node) const {
    return NodeId{static_cast<std::uint32_t>(&node - &graph_[NodeId{0}])};
  }

  const ir::Graph& graph_;
  const std::vector<std::uint32_t>& partner_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> known_;
};

}  // namespace

bool linear_in(const ir::Graph& graph, std::span<const NodeId> roots,
               const std::vector<bool>& summed) {
  std::vector<Degree> degrees;
  for (std::uint32_t i = 0; i < graph.size(); ++i)
    degrees.push_back(degree_of(graph, NodeId{i}, summed, degrees));
  for (const NodeId root : roots) {
    const Degree degree = degrees[ir::index(root)];
    if (degree != Degree::Linear && degree != Degree::Zero) return false;
  }
  return true;
}

bool equal_when_exchanged(const ir::Graph& graph, NodeId a, NodeId b,
                          const std::vector<std::uint32_t>& partner) {
  return Exchange(graph, partner).sign(a, b) == 1;
}

}  // namespace gmsim::engine
