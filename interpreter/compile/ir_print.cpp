// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <vector>

#include "compile/ir.h"

namespace gmsim::compile::ir {
namespace {

std::string input_text(const Input& input) {
  switch (input.source) {
    case Input::Source::Embedding: {
      const std::string part = input.offset == 0 ? "" : fmt::format("[{}]", input.offset);
      return fmt::format("embedding {}{} of role {}", types::index(input.embedding), part,
                         input.role);
    }
    case Input::Source::MatchValue: return fmt::format("match value {}", input.role);
    case Input::Source::ForceOn:
      return input.offset == 0 ? fmt::format("force on role {}", input.role)
                               : fmt::format("force of interaction {} on role {}", input.offset - 1,
                                             input.role);
    case Input::Source::AtomicForce: return fmt::format("atomic force {}", input.role);
    case Input::Source::Time: return "time";
    case Input::Source::Dt: return "dt";
    case Input::Source::Step: return "step";
  }
  return "";
}

std::string node_text(const Graph& graph, const Node& node) {
  if (node.op == Op::Constant) return fmt::format("{}", node.constant);
  if (node.op == Op::Input) return input_text(graph.inputs()[node.aux]);
  std::string text{name_of(node.op)};
  for (const NodeId operand : node.operands)
    if (operand != kNone) text += fmt::format(" n{}", index(operand));
  return node.op == Op::Component ? text + fmt::format(" [{}]", node.aux) : text;
}

}  // namespace

std::string to_string(const Graph& graph, std::span<const NodeId> roots) {
  const std::vector<bool> used = reachable(graph, roots);
  std::string text;
  for (std::uint32_t i = 0; i < graph.size(); ++i)
    if (used[i])
      text += fmt::format("n{} : {} = {}\n", i,
                          types::to_string(types::ValueType{graph[NodeId{i}].type, {}}),
                          node_text(graph, graph[NodeId{i}]));
  return text;
}

}  // namespace gmsim::compile::ir
