// SPDX-License-Identifier: MIT
#include <bit>
#include <cmath>
#include <utility>

#include "compile/ir.h"
#include "compile/ir_simplify.h"
#include "support/check.h"

namespace gmsim::compile::ir {
namespace {

struct OpInfo {
  std::string_view name;
  int operands;
};
constexpr OpInfo kOps[] = {
#define IR_OP(id, name, operands, meaning) {name, operands},
#include "compile/ir_ops.def"
#undef IR_OP
};

ValueKind result_type(const Graph& graph, Op op, NodeId a, NodeId b) {
  switch (op) {
    case Op::Vector: case Op::Cross: case Op::Normalize: case Op::MatVec:
    case Op::MaxEigenvector: case Op::MinEigenvector:
      return ValueKind::Vec3;
    case Op::Outer: case Op::MatMul: case Op::Transpose: case Op::Full: case Op::Columns: case Op::Polar:
      return ValueKind::Mat3;
    case Op::Sym: case Op::Diagonal:
      return ValueKind::Sym3;
    case Op::Less: case Op::LessEqual: case Op::Equal: case Op::And: case Op::Or: case Op::Not:
      return ValueKind::Bool;
    case Op::Add: case Op::Sub: case Op::Neg: case Op::Div: case Op::Inverse: case Op::Frozen:
      return graph[a].type;
    case Op::Scale: case Op::Select:
      return graph[b].type;
    default:
      return ValueKind::Real;
  }
}

std::size_t mix(std::size_t hash, std::uint64_t value) {
  hash ^= value + 0x9e3779b97f4a7c15ull + (hash << 6) + (hash >> 2);
  return hash;
}

std::size_t hash_of(const Node& node) {
  std::size_t hash = static_cast<std::size_t>(node.op);
  hash = mix(hash, static_cast<std::uint64_t>(node.type));
  for (const NodeId operand : node.operands) hash = mix(hash, index(operand));
  hash = mix(hash, std::bit_cast<std::uint64_t>(node.constant));
  return mix(hash, node.aux);
}

bool same(const Node& x, const Node& y) {
  return x.op == y.op && x.type == y.type && x.operands == y.operands && x.aux == y.aux &&
         std::bit_cast<std::uint64_t>(x.constant) == std::bit_cast<std::uint64_t>(y.constant);
}

}  // namespace

std::string_view name_of(Op op) { return kOps[static_cast<std::size_t>(op)].name; }
int operand_count(Op op) { return kOps[static_cast<std::size_t>(op)].operands; }

std::size_t InputHash::operator()(const Input& input) const {
  std::size_t hash = static_cast<std::size_t>(input.source);
  hash = mix(hash, types::index(input.embedding));
  return mix(mix(hash, input.role), input.offset);
}

NodeId Graph::intern(const Node& node) {
  std::vector<NodeId>& bucket = table_[hash_of(node)];
  for (const NodeId known : bucket)
    if (same(nodes_[compile::ir::index(known)], node)) return known;
  const NodeId id{static_cast<std::uint32_t>(nodes_.size())};
  nodes_.push_back(node);
  bucket.push_back(id);
  return id;
}

NodeId Graph::constant(double value) {
  return intern({.op = Op::Constant, .type = ValueKind::Real, .constant = value});
}

NodeId Graph::mask(bool value) {
  return intern({.op = Op::Constant, .type = ValueKind::Bool, .constant = value ? 1.0 : 0.0});
}

NodeId Graph::zero(ValueKind type) { return intern({.op = Op::Constant, .type = type}); }

NodeId Graph::input(const Input& input, ValueKind type, Span span) {
  const auto [known, added] =
      input_numbers_.try_emplace(input, static_cast<std::uint32_t>(inputs_.size()));
  if (added) inputs_.push_back(input);
  return intern({.op = Op::Input, .type = type, .aux = known->second, .span = span});
}

bool Graph::is_zero(NodeId id) const {
  const Node& node = (*this)[id];
  return node.op == Op::Constant && node.constant == 0.0;
}

NodeId Graph::make(Op op, NodeId a, NodeId b, NodeId c, std::uint32_t aux, Span span) {
  if (const auto simpler = simplify(*this, op, a, b, c, aux, span)) return *simpler;
  Node node{.op = op, .type = result_type(*this, op, a, b), .aux = aux, .span = span};
  node.operands = {a, b, c};
  return intern(node);
}

NodeId Graph::make_plain(Op op, NodeId a, NodeId b, NodeId c, std::uint32_t aux, Span span) {
  Node node{.op = op, .type = result_type(*this, op, a, b), .aux = aux, .span = span};
  node.operands = {a, b, c};
  return intern(node);
}

std::vector<bool> reachable(const Graph& graph, std::span<const NodeId> roots) {
  std::vector<bool> used(graph.size(), false);
  for (const NodeId root : roots)
    if (root != kNone) used[index(root)] = true;
  for (std::size_t i = graph.size(); i-- > 0;) {  // operands stand before their users
    if (!used[i]) continue;
    for (const NodeId operand : graph[NodeId{static_cast<std::uint32_t>(i)}].operands)
      if (operand != kNone) used[index(operand)] = true;
  }
  return used;
}

}  // namespace gmsim::compile::ir
