// SPDX-License-Identifier: MIT
#include "compile/force_assembly.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "compile/ir_builder.h"

namespace gmsim::compile {

using ir::NodeId;
using ir::Op;

void ForceAssembly::add_lines(const std::vector<BodyForce>& lines) {
  for (std::uint32_t k = 0; k < lines.size() && !walker_.failed(); ++k) {
    const BodyForce& line = lines[k];
    if (line.collection == nullptr) {
      const NodeId part = explicit_part(line);
      for (const ExprPtr& target : line.targets) add_target(line, k, walker_.dart(*target), part);
      continue;
    }
    std::vector<DartRef> members;
    walker_.darts(*line.collection, members);
    for (const DartRef& member : members) {
      walker_.bind(line.variable, member);
      const NodeId part = explicit_part(line);
      for (const ExprPtr& target : line.targets) add_target(line, k, walker_.dart(*target), part);
    }
  }
}

NodeId ForceAssembly::explicit_part(const BodyForce& line) {
  if (line.value == nullptr) return ir::kNone;
  const SymbolicValue value = walker_.evaluate(*line.value);
  if (graph_ == nullptr || walker_.failed()) return ir::kNone;
  return value.known ? graph_->zero(ir::ValueKind::Vec3) : value.parts[0];  // the literal 0
}

void ForceAssembly::add_target(const BodyForce& line, std::uint32_t number, DartRef target,
                               NodeId explicit_part) {
  if (walker_.failed()) return;
  const World& world = walker_.world();
  const std::uint32_t role = walker_.meet(world.schema[world.position].orbit, target);
  walker_.trace().target(target.walk);
  darts_.push_back(target.dart);
  const auto root = std::find_if(roots_.begin(), roots_.end(),
                                 [&](const ForceRoot& known) { return known.role == role; });
  targets_.push_back({number, static_cast<std::uint32_t>(root - roots_.begin()), line.orbit});
  if (root == roots_.end()) {
    roots_.push_back({role, explicit_part});
  } else if (explicit_part != ir::kNone) {
    root->total = sum(root->total, explicit_part);
  }
}

namespace {

/// factor * vector, the minus sign of the whole included.
struct Multiple {
  NodeId factor;
  NodeId vector;
};

std::optional<Multiple> multiple(ir::Graph& graph, NodeId id) {
  const bool negative = graph[id].op == Op::Neg;
  const ir::Node node = graph[negative ? graph[id].operands[0] : id];
  if (node.op != Op::Scale) return std::nullopt;
  const NodeId factor = node.operands[0];
  return Multiple{negative ? graph.make(Op::Neg, factor) : factor, node.operands[1]};
}

}  // namespace

NodeId ForceAssembly::sum(NodeId a, NodeId b) {
  if (a == ir::kNone || b == ir::kNone) return a == ir::kNone ? b : a;
  const auto x = multiple(*graph_, a), y = multiple(*graph_, b);
  if (x && y && x->vector == y->vector)
    return graph_->make(Op::Scale, graph_->make(Op::Add, x->factor, y->factor), x->vector);
  return graph_->make(Op::Add, a, b);
}

namespace {

/// Does y depend on one of `ends` other than through `middle`?
bool passes_by(const ir::Graph& graph, NodeId y, NodeId middle, const std::vector<NodeId>& ends) {
  std::vector<bool> reached(ir::index(y) + std::size_t{1}, false);
  reached[ir::index(y)] = true;
  for (std::uint32_t i = ir::index(y) + 1; i-- > 0;) {
    if (!reached[i] || NodeId{i} == middle) continue;
    if (std::find(ends.begin(), ends.end(), NodeId{i}) != ends.end()) return true;
    for (const NodeId operand : graph[NodeId{i}].operands)
      if (operand != ir::kNone) reached[ir::index(operand)] = true;
  }
  return false;
}

}  // namespace

std::vector<NodeId> ForceAssembly::gradient(NodeId energy, const std::vector<NodeId>& positions) {
  for (const NodeId middle : walker_.differentiated()) {
    const bool inside = ir::index(middle) < ir::index(energy);
    if (!inside || passes_by(*graph_, energy, middle, positions)) continue;
    const NodeId slope = ir::gradient(*graph_, energy, std::vector{middle})[0];
    std::vector<NodeId> result = ir::gradient(*graph_, middle, positions);
    for (NodeId& part : result) part = graph_->make(Op::Scale, slope, part);
    return result;
  }
  return ir::gradient(*graph_, energy, positions);
}

void ForceAssembly::subtract_gradient(NodeId energy, Span energy_span) {
  std::vector<std::uint32_t> roles;
  std::vector<NodeId> positions;
  for (std::uint32_t role = 0; role < walker_.positions().size(); ++role) {
    if (walker_.positions()[role] == ir::kNone) continue;
    roles.push_back(role);
    positions.push_back(walker_.positions()[role]);
  }
  const std::vector<NodeId> slopes = gradient(energy, positions);
  for (std::size_t k = 0; k < roles.size(); ++k) {
    if (graph_->is_zero(slopes[k])) continue;
    const auto root = std::find_if(roots_.begin(), roots_.end(), [&](const ForceRoot& known) {
      return known.role == roles[k];
    });
    if (root == roots_.end()) {
      const Role& vertex = walker_.roles().roles()[roles[k]];
      walker_.fail(support::DiagnosticKind::ForceMissing, energy_span,
                   fmt::format("the energy depends on the position at dart {}, which no `force` "
                               "line names",
                               types::index(vertex.dart)),
                   "name every vertex whose position the energy reads, also through derived "
                   "values");
      return;
    }
    root->total = sum(graph_->make(Op::Neg, slopes[k]), root->total);
  }
}

void ForceAssembly::finish(NodeId energy, Span energy_span, Shape& shape) {
  if (energy != ir::kNone) subtract_gradient(energy, energy_span);
  for (ForceRoot& root : roots_)
    if (root.total == ir::kNone) root.total = graph_->zero(ir::ValueKind::Vec3);
  shape.forces = std::move(roots_);
  shape.targets = std::move(targets_);
}

}  // namespace gmsim::compile
