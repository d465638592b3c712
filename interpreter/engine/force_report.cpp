// SPDX-License-Identifier: MIT
#include "engine/force_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gmsim::engine {

namespace ir = compile::ir;
using ir::NodeId;

namespace {

using Evaluator = IrEvaluator<double>;

bool finite(const ir::Graph& graph, const Evaluator& evaluator, NodeId id) {
  const ir::Node& node = graph[id];
  const std::uint32_t count =
      node.type == types::ValueKind::Bool ? 1 : types::component_count({node.type});
  const auto& entries = evaluator[id];
  return std::all_of(entries.begin(), entries.begin() + count,
                     [](double x) { return std::isfinite(x); });
}

/// The first node on which a root depends for which `wrong` holds.
template <typename Wrong>
NodeId first_node(const ForceProgram& program, const Wrong& wrong) {
  const std::vector<bool> used = ir::reachable(program.graph, program.roots);
  for (std::uint32_t i = 0; i < used.size(); ++i)
    if (used[i] && wrong(NodeId{i})) return NodeId{i};
  return ir::kNone;
}

support::Span span_at(const ForceProgram& program, NodeId id, const compile::ItemBody& body) {
  const support::Span span = id == ir::kNone ? support::Span{} : program.graph[id].span;
  return span.begin == span.end ? body.name_span : span;
}

}  // namespace

std::string match_text(const compile::ItemBody& body, const ForceMatch& match) {
  std::string text;
  for (std::size_t i = 0; i < match.nodes.size(); ++i) {
    const std::uint32_t slot = types::index(body.nodes[i]);
    const bool named = slot < body.slot_names.size() && !body.slot_names[slot].empty();
    if (i > 0) text += ", ";
    if (named) text += body.slot_names[slot] + " = ";
    text += fmt::to_string(types::index(match.nodes[i]));
  }
  return text;
}

support::Diagnostic non_finite(const compile::ItemBody& body, const ForceMatch& match,
                               const ForceProgram& program, const Evaluator& evaluator) {
  const NodeId origin = first_node(program, [&](NodeId id) {
    return !finite(program.graph, evaluator, id);
  });
  support::Diagnostic diagnostic{
      support::DiagnosticKind::NonFinite,
      fmt::format("`{}` has no finite value at the match {}", body.name, match_text(body, match)),
      span_at(program, origin, body)};
  if (origin == ir::kNone) return diagnostic;
  const ir::Node& node = program.graph[origin];
  std::string operands;
  for (int k = 0; k < ir::operand_count(node.op); ++k) {
    const NodeId operand = node.operands[k];
    const bool number = program.graph[operand].type <= types::ValueKind::Real;
    operands += number ? fmt::format("{}{}", operands.empty() ? "" : ", ", evaluator.number(operand))
                       : fmt::format("{}…", operands.empty() ? "" : ", ");
  }
  diagnostic.notes.push_back(node.op == ir::Op::Input
                                 ? "a value that it reads is not finite"
                                 : fmt::format("here {}({}) is not finite", ir::name_of(node.op),
                                               operands));
  return diagnostic;
}

support::Diagnostic no_direction(const compile::ItemBody& body, const ForceMatch& match,
                                 const ForceProgram& program, const Evaluator& evaluator) {
  const NodeId origin = first_node(program, [&](NodeId id) {
    return program.graph[id].op == ir::Op::Norm && evaluator.number(id) == 0;
  });
  support::Diagnostic diagnostic{
      support::DiagnosticKind::NonFinite,
      fmt::format("a vector of length zero has no direction: `{}` has no force along it at the "
                  "match {}",
                  body.name, match_text(body, match)),
      span_at(program, origin, body)};
  diagnostic.severity = support::Severity::Warning;
  return diagnostic;
}

}  // namespace gmsim::engine
