// SPDX-License-Identifier: MIT
#include "engine/force_program.h"

#include <algorithm>
#include <utility>

namespace gmsim::engine {

namespace ir = compile::ir;
using ir::NodeId;
using ir::Op;
using types::ValueKind;
using Kind = InputOrigin::Kind;

namespace {

NodeId where_it_holds(ir::Graph& graph, const compile::Shape& shape, NodeId value) {
  if (shape.condition == ir::kNone) return value;
  return graph.make(Op::Select, shape.condition, value, graph.zero(graph[value].type));
}

/// Lists the inputs that the roots depend on. `origins` by number in graph.inputs().
void list_inputs(ForceProgram& program, const std::vector<InputOrigin>& origins) {
  const std::vector<bool> used = ir::reachable(program.graph, program.roots);
  std::vector<bool> live(origins.size(), false);
  for (std::uint32_t i = 0; i < used.size(); ++i) {
    const ir::Node& node = program.graph[NodeId{i}];
    if (used[i] && node.op == Op::Input) live[node.aux] = true;
  }
  for (std::uint32_t number = 0; number < live.size(); ++number)
    if (live[number]) program.inputs.push_back({number, origins[number]});
}

/// Which nodes depend on an input of this kind.
std::vector<bool> depends_on(const ir::Graph& graph, const std::vector<InputOrigin>& origins,
                             Kind kind) {
  std::vector<bool> result(graph.size(), false);
  for (std::uint32_t i = 0; i < graph.size(); ++i) {
    const ir::Node& node = graph[NodeId{i}];
    if (node.op == Op::Input) result[i] = origins[node.aux].kind == kind;
    for (const NodeId operand : node.operands)
      if (operand != ir::kNone && result[ir::index(operand)]) result[i] = true;
  }
  return result;
}

/// The moving inputs of a program and, for each, an input for its change.
struct Changes {
  std::vector<NodeId> inputs;
  std::vector<NodeId> seeds;
  std::vector<InputOrigin> origins;  ///< of all inputs, the changes included
};

Changes add_changes(ForceProgram& program) {
  // Numbers of a match's own that no draw has: they only have to be inputs of their own.
  constexpr std::uint32_t kFirst = 0x80000000u;
  Changes changes;
  changes.origins.resize(program.graph.inputs().size(), InputOrigin{.width = 0});
  for (const auto& [number, origin] : program.inputs) changes.origins[number] = origin;
  const auto end = static_cast<std::uint32_t>(program.graph.size());
  for (std::uint32_t i = 0; i < end; ++i) {
    const ir::Node node = program.graph[NodeId{i}];
    if (node.op != Op::Input) continue;
    InputOrigin origin = changes.origins[node.aux];
    if (origin.kind != Kind::Position && origin.kind != Kind::Velocity) continue;
    origin.kind =
        origin.kind == Kind::Position ? Kind::PositionChange : Kind::VelocityChange;
    const ir::Input change{.source = ir::Input::Source::MatchValue, .role = kFirst + i};
    changes.inputs.push_back(NodeId{i});
    changes.seeds.push_back(program.graph.input(change, ValueKind::Vec3, node.span));
    changes.origins.push_back(origin);
  }
  return changes;
}

}  // namespace

bool ForceProgram::reads(InputOrigin::Kind kind) const {
  return std::any_of(inputs.begin(), inputs.end(),
                     [&](const LiveInput& input) { return input.origin.kind == kind; });
}

ForceProgram force_program(const compile::Shape& shape, const ShapeInputs& inputs) {
  ForceProgram program{.graph = shape.graph, .roots = {}, .inputs = {}};
  for (const compile::ForceRoot& force : shape.forces)
    program.roots.push_back(where_it_holds(program.graph, shape, force.total));
  list_inputs(program, inputs.origins());
  return program;
}

ForceProgram values_program(const compile::Shape& shape, const ShapeInputs& inputs,
                            std::size_t first, std::size_t count) {
  ForceProgram program{.graph = shape.graph, .roots = {}, .inputs = {}};
  for (std::size_t k = first; k < first + count; ++k)
    for (const NodeId part : shape.values[k])
      program.roots.push_back(where_it_holds(program.graph, shape, part));
  list_inputs(program, inputs.origins());
  return program;
}

ForceProgram energy_program(const compile::Shape& shape, const ShapeInputs& inputs) {
  ForceProgram program{.graph = shape.graph, .roots = {}, .inputs = {}};
  if (shape.energy == ir::kNone) return program;
  program.roots = {where_it_holds(program.graph, shape, shape.energy)};
  list_inputs(program, inputs.origins());
  return program;
}

ForceProgram product_program(const ForceProgram& force) {
  ForceProgram program{.graph = force.graph, .roots = {}, .inputs = force.inputs};
  const Changes changes = add_changes(program);
  program.inputs.clear();
  for (const NodeId root : force.roots)
    program.roots.push_back(ir::directional(program.graph, root, changes.inputs, changes.seeds));
  list_inputs(program, changes.origins);
  return program;
}

ForceProgram direction_program(const compile::Shape& shape, const ShapeInputs& inputs) {
  ForceProgram program{.graph = shape.graph, .roots = {}, .inputs = {}};
  ir::Graph& graph = program.graph;
  const std::vector<bool> used = ir::reachable(graph, shape.roots());
  const std::vector<bool> from_position = depends_on(graph, inputs.origins(), Kind::Position);
  const std::vector<bool> from_velocity = depends_on(graph, inputs.origins(), Kind::Velocity);
  NodeId none = ir::kNone;
  for (std::uint32_t i = 0; i < used.size(); ++i) {
    const ir::Node node = graph[NodeId{i}];
    if (!used[i] || (node.op != Op::Norm && node.op != Op::Normalize)) continue;
    if (!from_position[i] || from_velocity[i]) continue;
    const NodeId length = graph.make(Op::Norm, node.operands[0]);
    const NodeId is_zero = graph.make(Op::Equal, length, graph.constant(0));
    none = none == ir::kNone ? is_zero : graph.make(Op::Or, none, is_zero);
  }
  if (none == ir::kNone) return program;
  program.roots = {where_it_holds(graph, shape, graph.make(Op::AsReal, none))};
  list_inputs(program, inputs.origins());
  return program;
}

}  // namespace gmsim::engine
