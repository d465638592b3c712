// SPDX-License-Identifier: MIT
#include "scene/read_changes.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/expression_facts.h"
#include "support/suggest.h"

namespace gmsim::scene {
namespace {

using support::DiagnosticKind;

/// SI units in the unit in which a parameter is declared: a bare number is in that one.
double scale_of(const engine::NamedChange& change, const std::string& parameter,
                const check::RuleLibrary& library) {
  const auto& parameters = change.operation ? library.operations[change.target].parameters
                                            : library.rules[change.target].parameters;
  const auto found = std::ranges::find(parameters, parameter, &check::Parameter::name);
  return found == parameters.end() ? 1.0 : found->unit_scale;
}

/// The parameter of an item that a key names.
const compile::Parameter* parameter_of(const YamlEntry& entry, const compile::ItemHead& item,
                                       ReadContext& context) {
  if (const compile::Parameter* parameter = item.find_parameter(entry.key)) return parameter;
  const std::vector<std::string> names = names_of(item.parameters);
  const std::string guess = support::did_you_mean(entry.key, names);
  context.report(DiagnosticKind::UnknownName, entry.key_span,
                 fmt::format("`{}` has no parameter `{}`", item.name, entry.key),
                 !guess.empty() ? guess
                 : names.empty()
                     ? "it has none"
                     : fmt::format("its parameters are `{}`", fmt::join(names, "`, `")));
  return nullptr;
}

}  // namespace

const compile::ItemHead& change_head(const engine::NamedChange& change,
                                     const compile::Program& program) {
  if (change.operation) return program.operations[change.target];
  return program.rules[change.target];
}

std::optional<engine::NamedChange> read_change(const YamlNode& node, ReadContext& context) {
  const compile::Program& program = context.program;
  for (std::uint32_t i = 0; i < program.rules.size(); ++i)
    if (program.rules[i].name == node.text) return engine::NamedChange{false, i};
  for (std::uint32_t i = 0; i < program.operations.size(); ++i)
    if (program.operations[i].name == node.text) return engine::NamedChange{true, i};
  std::vector<std::string> names = names_of(program.rules);
  const std::vector<std::string> operations = names_of(program.operations);
  names.insert(names.end(), operations.begin(), operations.end());
  context.report_unknown_item(node, "rule or operation", names);
  return std::nullopt;
}

std::optional<std::pair<const compile::Parameter*, SceneExpression>> read_parameter(
    const YamlEntry& entry, const engine::NamedChange& change, ReadContext& context) {
  const compile::Parameter* parameter =
      parameter_of(entry, change_head(change, context.program), context);
  if (parameter == nullptr) return std::nullopt;
  return std::pair{parameter,
                   context.expression(entry.value,
                                      {.type = parameter->type,
                                       .unit = parameter->unit,
                                       .unit_scale = scale_of(change, entry.key, context.library())})};
}

std::vector<std::pair<const compile::Parameter*, SceneExpression>> read_parameters(
    const YamlNode* params, const engine::NamedChange& change, ReadContext& context) {
  std::vector<std::pair<const compile::Parameter*, SceneExpression>> result;
  if (params == nullptr) return result;
  for (const YamlEntry& entry : params->entries)
    if (auto parameter = read_parameter(entry, change, context))
      result.push_back(std::move(*parameter));
  return result;
}

void require_parameters(const std::vector<const compile::Parameter*>& given,
                        const engine::NamedChange& change, support::Span span,
                        ReadContext& context) {
  const compile::ItemHead& item = change_head(change, context.program);
  for (const compile::Parameter& parameter : item.parameters) {
    if (parameter.default_value || std::ranges::find(given, &parameter) != given.end()) continue;
    context.report(
        DiagnosticKind::MissingKey, span,
        fmt::format("`{}` needs its parameter `{}`", item.name, parameter.name),
        fmt::format("give it under `params`: {}{}", types::to_string(parameter.type),
                    parameter.unit ? " [" + types::to_string(*parameter.unit) + "]" : ""));
  }
}

std::optional<types::OrbitType> read_candidates(const YamlNode& section,
                                                const engine::NamedChange& change,
                                                support::Span span, ReadContext& context) {
  const compile::Program& program = context.program;
  if (!change.operation && program.rules[change.target].match.hooks.size() != 1) {
    const compile::Rule& rule = program.rules[change.target];
    context.report(DiagnosticKind::BadItem, span,
                   fmt::format("`{}` has {} hooks, so candidates cannot be listed for it",
                               rule.name, rule.match.hooks.size()),
                   "use a rule with one hook, or an operation");
    return std::nullopt;
  }
  if (const YamlNode* to = section.find("to")) return context.orbit(*to);
  return change.operation ? program.operations[change.target].orbit
                          : program.rules[change.target].match.hook_orbit();
}

std::vector<Preparation> read_preparations(const YamlNode& body, ReadContext& context) {
  std::vector<Preparation> result;
  for (const YamlNode& section : body.find("prepare")->items) {
    const YamlNode* apply = section.find("apply");
    Preparation preparation{.where = context.where(section)};
    const auto change = apply ? read_change(*apply, context) : std::optional<engine::NamedChange>{};
    if (!change) continue;
    preparation.change = *change;
    preparation.name = apply->text;
    preparation.span = apply->span;
    preparation.times = context.integer(*section.find("times"));
    std::vector<const compile::Parameter*> given;
    for (auto& [parameter, value] : read_parameters(section.find("params"), *change, context)) {
      given.push_back(parameter);
      if (auto constant = context.constant(value, fmt::format("`{}`", parameter->name)))
        preparation.arguments.emplace_back(parameter->slot, std::move(*constant));
    }
    require_parameters(given, *change, apply->span, context);
    const auto to = read_candidates(section, *change, apply->span, context);
    if (!to) continue;
    preparation.to = *to;
    result.push_back(std::move(preparation));
  }
  return result;
}

}  // namespace gmsim::scene
