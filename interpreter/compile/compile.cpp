// SPDX-License-Identifier: MIT
#include "compile/compile.h"

#include <algorithm>
#include <type_traits>

namespace gmsim::compile {

namespace {

void fill_head(ItemHead& head, const check::ItemHead& item,
               const std::vector<check::Parameter>& parameters) {
  head.name = item.name;
  head.name_span = item.name_span;
  head.from_library = item.from_library;
  head.frame_size = item.frame_size;
  head.slot_names = item.slot_names;
  for (const check::Parameter& parameter : parameters) {
    head.parameters.push_back({parameter.name, parameter.type, parameter.unit, parameter.slot,
                               parameter.default_value, parameter.span});
  }
}

RootedPattern rooted(const check::Interaction& interaction) {
  RootedPattern pattern;
  fill_head(pattern, interaction, interaction.parameters);
  pattern.orbit = interaction.orbit;
  pattern.match = compile_pattern(interaction.match, {interaction.hook});
  pattern.first = interaction.first;
  pattern.first_dart = interaction.first_dart;
  pattern.presence = interaction.presence;
  return pattern;
}

RootedPattern rooted(const check::Criterion& criterion, const check::RuleLibrary& library) {
  RootedPattern pattern;
  fill_head(pattern, criterion, criterion.parameters);
  pattern.orbit = criterion.orbit;
  pattern.match = compile_pattern(criterion.match, {criterion.hook});
  if (criterion.interaction) {
    const check::Interaction& of = library.interactions[types::index(*criterion.interaction)];
    pattern.first = of.first;
    pattern.first_dart = of.first_dart;
    pattern.presence = of.presence;
  }
  return pattern;
}

std::vector<Statement> statements(const std::vector<check::OperationStatement>& body);

LetStatement translate(const check::OpLet& let) { return {let.slot, let.value}; }
AssignStatement translate(const check::OpAssign& assign) {
  return {assign.dart, assign.embedding, assign.value};
}
ForStatement translate(const check::OpFor& loop) {
  return {loop.variable, loop.collection, loop.condition, statements(loop.body)};
}
IfStatement translate(const check::OpIf& branch) {
  return {branch.condition, statements(branch.then_body), statements(branch.else_body)};
}
ApplyStatement translate(const check::OpApply& apply) {
  return {apply.operation, apply.target, apply.darts, apply.parameters};
}

std::vector<Statement> statements(const std::vector<check::OperationStatement>& body) {
  std::vector<Statement> result;
  for (const check::OperationStatement& statement : body) {
    const auto to_plan = [](const auto& node) -> decltype(Statement::node) {
      return translate(node);
    };
    result.push_back({statement.span, std::visit(to_plan, statement.node)});
  }
  return result;
}

Operation compile_operation(const check::Operation& operation) {
  Operation result;
  fill_head(result, operation, operation.parameters);
  result.orbit = operation.orbit;
  result.dart = operation.dart;
  result.body = statements(operation.body);
  return result;
}

template <typename Items>
auto find_named(const Items& items, std::string_view name) {
  const auto found = std::find_if(items.begin(), items.end(),
                                  [&](const auto& item) { return item.name == name; });
  return found == items.end() ? nullptr : &*found;
}

}  // namespace

const Parameter* ItemHead::find_parameter(std::string_view parameter) const {
  return find_named(parameters, parameter);
}
const Rule* Program::find_rule(std::string_view name) const { return find_named(rules, name); }
const Operation* Program::find_operation(std::string_view name) const {
  return find_named(operations, name);
}

Rule compile_rule(const check::Rule& rule, const gmap::EmbeddingSchema& schema) {
  Rule result;
  fill_head(result, rule, rule.parameters);
  result.match = compile_pattern(rule.left, rule.hooks);
  add_predicates(result.match, rule.parameters, rule.steps, schema);
  result.rewrite = compile_rewrite(rule, schema);
  result.match.width = result.rewrite.kept_columns + result.rewrite.created_columns;
  return result;
}

Program compile_program(const check::RuleLibrary& library) {
  Program program;
  program.dimension = library.dimension;
  program.schema = library.schema;
  for (const auto& rule : library.rules) program.rules.push_back(compile_rule(rule, library.schema));
  for (const auto& operation : library.operations) {
    program.operations.push_back(compile_operation(operation));
  }
  for (const auto& item : library.interactions) program.interactions.push_back(rooted(item));
  for (const auto& item : library.criteria) program.criteria.push_back(rooted(item, library));
  for (const auto& item : library.interactions) {
    program.interaction_bodies.push_back(compile_body(item));
  }
  for (const auto& item : library.criteria) program.criterion_bodies.push_back(compile_body(item));
  return program;
}

}  // namespace gmsim::compile
