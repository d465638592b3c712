// SPDX-License-Identifier: MIT
#include "compile/specialise.h"

#include <fmt/format.h>

#include <utility>

#include "compile/force_assembly.h"
#include "compile/symbolic_walker.h"

namespace gmsim::compile {

using types::ValueKind;

Wanted wanted_forces(const InteractionBody& body, bool energy_value) {
  return {.energy = body.energy, .energy_value = energy_value && body.energy != nullptr,
          .forces = &body.forces};
}

Wanted wanted_values(const CriterionBody& body) {
  Wanted wanted{.values = {body.value}};
  for (const BodyResult& result : body.results) wanted.values.push_back(result.value);
  return wanted;
}

Wanted wanted_results(const InteractionBody& body) {
  Wanted wanted;
  for (const BodyResult& result : body.results) wanted.values.push_back(result.value);
  return wanted;
}

// ---- shapes -------------------------------------------------------------------------------------

std::vector<ir::NodeId> Shape::roots() const {
  std::vector<ir::NodeId> all;
  for (const ir::NodeId root : {condition, energy})
    if (root != ir::kNone) all.push_back(root);
  for (const ForceRoot& force : forces) all.push_back(force.total);
  for (const auto& parts : values) all.insert(all.end(), parts.begin(), parts.end());
  return all;
}

std::vector<std::uint32_t> Shape::live_inputs() const {
  const std::vector<bool> used = ir::reachable(graph, roots());
  std::vector<bool> live(graph.inputs().size(), false);
  for (std::uint32_t i = 0; i < used.size(); ++i) {
    const ir::Node& node = graph[ir::NodeId{i}];
    if (used[i] && node.op == ir::Op::Input) live[node.aux] = true;
  }
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < live.size(); ++i)
    if (live[i]) numbers.push_back(i);
  return numbers;
}

// ---- one match ----------------------------------------------------------------------------------

Specialiser::Specialiser(const World& world, const ItemBody& body, Wanted wanted,
                         const ValueSources& sources)
    : wanted_(std::move(wanted)),
      walker_(std::make_unique<SymbolicWalker>(world, body, sources)) {}
Specialiser::~Specialiser() = default;

bool Specialiser::trace(std::span<const DartId> nodes, MatchRoles& out) {
  return run(nodes, out, nullptr);
}

bool Specialiser::build(std::span<const DartId> nodes, MatchRoles& out, Shape& shape) {
  shape = {};
  return run(nodes, out, &shape);
}

namespace {

/// Conditions that are known to be false at this match.
SpecialiseFailure excluded(const ItemBody& body) {
  return {true,
          {support::DiagnosticKind::NoMatch,
           fmt::format("the conditions of `{}` do not hold", body.name), body.name_span}};
}

}  // namespace

bool Specialiser::run(std::span<const DartId> nodes, MatchRoles& out, Shape* shape) {
  SymbolicWalker& walker = *walker_;
  ir::Graph* graph = shape != nullptr ? &shape->graph : nullptr;
  walker.start(nodes, graph);
  const SymbolicValue condition = walker.conditions();
  if (condition.known && condition.number == 0.0 && !walker.failed()) {
    walker.take_walked(out);
    failure_ = excluded(walker.body());
    return false;
  }
  SymbolicValue energy;
  if (wanted_.energy) energy = walker.evaluate(*wanted_.energy);
  ForceAssembly forces(walker, graph);
  if (wanted_.forces != nullptr) forces.add_lines(*wanted_.forces);
  std::vector<std::vector<ir::NodeId>> values;
  for (const ExprPtr& value : wanted_.values)
    values.push_back(walker.nodes(walker.evaluate(*value), value->type));
  if (shape != nullptr && !walker.failed()) {
    if (!condition.known) shape->condition = walker.node(condition, {ValueKind::Bool});
    const ir::NodeId energy_node =
        wanted_.energy ? walker.node(energy, wanted_.energy->type) : ir::kNone;
    if (wanted_.energy_value) shape->energy = energy_node;
    if (wanted_.forces != nullptr)
      forces.finish(energy_node, wanted_.energy ? wanted_.energy->span : Span{}, *shape);
    shape->values = std::move(values);
    shape->draws = walker.draws();
  }
  walker.take_walked(out);
  if (walker.failed()) {
    failure_ = walker.take_failure();
    return false;
  }
  out.roles = walker.roles().take();
  out.targets = forces.take_darts();
  out.atomic = walker.take_atomic();
  out.key = walker.take_key();
  if (shape == nullptr) return true;
  shape->key = out.key;
  for (const Role& role : out.roles) shape->roles.push_back(role.type);
  return true;
}

}  // namespace gmsim::compile
