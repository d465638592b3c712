// SPDX-License-Identifier: MIT
#include "scene/read_tear.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/read_changes.h"
#include "support/suggest.h"

namespace gmsim::scene {
namespace {

using support::DiagnosticKind;

/// A `where` that is more than `true`.
std::optional<engine::DartExpression> condition(const YamlNode& section, ReadContext& context,
                                                MayRead allowed) {
  const YamlNode* node = section.find("where");
  const SceneExpression where = context.where(section, allowed);
  if (!where.good() || (node != nullptr && node->is_default)) return std::nullopt;
  return where.code;
}

class TearReader {
 public:
  TearReader(const YamlNode& section, ReadContext& context)
      : section_(section), context_(context), program_(context.program) {}

  std::optional<engine::TearPairing> read() {
    tear_.where = condition(section_, context_, MayRead::Forces);
    const bool known = find_criterion();
    const auto change = find_change(known);
    if (!known) return std::nullopt;
    read_threshold();
    tear_.after = context_.number(*section_.find("after"));
    tear_.refresh = section_.find("refresh")->text == "true";
    if (const YamlNode* at_most = section_.find("at_most"))
      tear_.at_most = static_cast<std::uint32_t>(context_.number(*at_most));
    read_nodes();
    if (!change) return std::nullopt;
    tear_.change = *change;
    read_parameters_of_both();
    (void)read_candidates(section_, *change, action_span(), context_);
    return std::move(tear_);
  }

 private:
  bool find_criterion() {
    const YamlNode* when = section_.find("when");
    if (when == nullptr) return false;
    tear_.span = when->span;
    const auto found =
        std::ranges::find(program_.criteria, when->text, &compile::RootedPattern::name);
    if (found == program_.criteria.end()) {
      context_.report_unknown_item(*when, "criterion", names_of(program_.criteria));
      return false;
    }
    tear_.criterion = static_cast<std::uint32_t>(found - program_.criteria.begin());
    return true;
  }

  /// What `do` names, or else what the criterion applies by default.
  std::optional<engine::NamedChange> find_change(bool criterion_known) {
    if (const YamlNode* action = section_.find("do")) return read_change(*action, context_);
    if (!criterion_known) return std::nullopt;
    const auto& change = body().change;
    if (change) return engine::NamedChange{change->operation, change->target};
    context_.report(DiagnosticKind::MissingKey, tear_.span,
                    fmt::format("`{}` applies nothing by default", criterion().name),
                    "say with `do` which rule or operation is applied where it fires");
    return std::nullopt;
  }

  [[nodiscard]] support::Span action_span() const {
    const YamlNode* action = section_.find("do");
    return action ? action->span : tear_.span;
  }
  [[nodiscard]] const compile::CriterionBody& body() const {
    return program_.criterion_bodies[tear_.criterion];
  }
  [[nodiscard]] const compile::RootedPattern& criterion() const {
    return program_.criteria[tear_.criterion];
  }

  /// `threshold`, in the unit of the criterion's value; it must be positive.
  void read_threshold() {
    const compile::Parameter* parameter = criterion().find_parameter("threshold");
    const YamlNode* node = section_.find("threshold");
    if (parameter == nullptr) return;
    tear_.threshold = parameter->slot;
    if (node == nullptr) return;
    const auto& declared = context_.library().criteria[tear_.criterion].parameters;
    const auto threshold = std::ranges::find(declared, "threshold", &check::Parameter::name);
    const double scale = threshold == declared.end() ? 1.0 : threshold->unit_scale;
    const SceneExpression value = context_.expression(
        *node, {.type = parameter->type, .unit = parameter->unit, .unit_scale = scale},
        MayRead::Derivatives);
    if (!value.good()) return;
    tear_.parameters.push_back({parameter->slot, value.code});
    if (!value.constant) return;
    const auto constant = context_.constant(value, "`threshold`");
    if (constant && constant->as_real() > 0) return;
    context_.report(DiagnosticKind::OutOfRange, node->span, "a threshold must be above 0");
  }

  void read_nodes() {
    const auto& nodes = criterion().match.nodes;
    const YamlNode* at = section_.find("at");
    if (at == nullptr) {
      const bool by_default = section_.find("do") == nullptr && body().change;
      tear_.at.push_back(by_default ? body().change->node : criterion().match.hooks.at(0));
      return;
    }
    for (const YamlNode& name : at->items) {
      const auto found = std::ranges::find(nodes, name.text, &compile::PlanNode::name);
      if (found != nodes.end()) {
        tear_.at.push_back(static_cast<std::uint32_t>(found - nodes.begin()));
        continue;
      }
      context_.report(DiagnosticKind::UnknownName, name.span,
                      fmt::format("`{}` has no node `{}`", criterion().name, name.text),
                      fmt::format("its nodes are `{}`", fmt::join(names_of(nodes), "`, `")));
    }
  }

  /// `params`: each goes to the criterion, to the change, or to both when both have one of its name.
  /// What the change still lacks are results of the criterion.
  void read_parameters_of_both() {
    std::vector<const compile::Parameter*> given;
    if (const YamlNode* params = section_.find("params"))
      for (const YamlEntry& entry : params->entries) read_parameter(entry, given);
    add_results(given);
    require_parameters(given, tear_.change, action_span(), context_);
    for (const compile::Parameter& parameter : criterion().parameters) {
      if (parameter.default_value || parameter.slot == tear_.threshold || is_given(parameter)) continue;
      context_.report(DiagnosticKind::MissingKey, tear_.span,
                      fmt::format("`{}` needs its parameter `{}`", criterion().name, parameter.name),
                      "give it under `params`");
    }
  }

  void read_parameter(const YamlEntry& entry, std::vector<const compile::Parameter*>& given) {
    const compile::ItemHead& change = change_head(tear_.change, program_);
    const compile::Parameter* of_criterion = criterion().find_parameter(entry.key);
    const compile::Parameter* of_change = change.find_parameter(entry.key);
    if (of_criterion && of_criterion->slot == tear_.threshold) of_criterion = nullptr;
    if (of_criterion) {
      const auto& declared = context_.library().criteria[tear_.criterion].parameters;
      const double scale = std::ranges::find(declared, entry.key, &check::Parameter::name)->unit_scale;
      tear_.parameters.push_back(
          {of_criterion->slot, context_.expression(entry.value, {.type = of_criterion->type,
                                                                 .unit = of_criterion->unit,
                                                                 .unit_scale = scale},
                                                   MayRead::Derivatives)
                                   .code});
    }
    if (!of_change) {
      if (!of_criterion) report_unknown_parameter(entry, change);
      return;
    }
    if (auto argument = scene::read_parameter(entry, tear_.change, context_)) {
      given.push_back(argument->first);
      tear_.arguments.push_back({argument->first->slot, std::nullopt, argument->second.code});
    }
  }

  void report_unknown_parameter(const YamlEntry& entry, const compile::ItemHead& change) {
    std::vector<std::string> names = names_of(change.parameters);
    for (const compile::Parameter& parameter : criterion().parameters)
      if (parameter.slot != tear_.threshold) names.push_back(parameter.name);
    const std::string guess = support::did_you_mean(entry.key, names);
    context_.report(DiagnosticKind::UnknownName, entry.key_span,
                    fmt::format("neither `{}` nor `{}` has a parameter `{}`", criterion().name,
                                change.name, entry.key),
                    !guess.empty()  ? guess
                    : names.empty() ? "they have none"
                                    : fmt::format("they have `{}`", fmt::join(names, "`, `")));
  }

  [[nodiscard]] bool is_given(const compile::Parameter& parameter) const {
    return std::ranges::find(tear_.parameters, parameter.slot, &engine::SlotValue::slot) !=
           tear_.parameters.end();
  }

  void add_results(std::vector<const compile::Parameter*>& given) {
    const auto& results = body().results;
    for (const compile::Parameter& parameter : change_head(tear_.change, program_).parameters) {
      const auto result = std::ranges::find(results, parameter.name, &compile::BodyResult::name);
      if (result == results.end() || std::ranges::find(given, &parameter) != given.end()) continue;
      given.push_back(&parameter);
      tear_.arguments.push_back(
          {parameter.slot, static_cast<std::uint32_t>(result - results.begin()), {}});
    }
  }

  const YamlNode& section_;
  ReadContext& context_;
  const compile::Program& program_;
  engine::TearPairing tear_;
};

}  // namespace

std::vector<engine::TearPairing> read_tears(const YamlNode& scene, ReadContext& context) {
  std::vector<engine::TearPairing> tears;
  for (const YamlNode& section : scene.find("tear")->items)
    if (auto tear = TearReader(section, context).read()) tears.push_back(std::move(*tear));
  return tears;
}

std::vector<engine::StandingRewrite> read_rewrites(const YamlNode& scene, ReadContext& context) {
  std::vector<engine::StandingRewrite> rewrites;
  for (const YamlNode& section : scene.find("rewrite")->items) {
    const YamlNode* apply = section.find("apply");
    engine::StandingRewrite rewrite{.change = {},
                                    .to = {},
                                    .where = condition(section, context, MayRead::Values),
                                    .parameters = {},
                                    .span = section.span};
    const auto change = apply ? read_change(*apply, context) : std::optional<engine::NamedChange>{};
    if (!change) continue;
    rewrite.change = *change;
    rewrite.span = apply->span;
    std::vector<const compile::Parameter*> given;
    for (auto& [parameter, value] : read_parameters(section.find("params"), *change, context)) {
      given.push_back(parameter);
      rewrite.parameters.push_back({parameter->slot, value.code});
    }
    require_parameters(given, *change, apply->span, context);
    const auto to = read_candidates(section, *change, apply->span, context);
    if (!to) continue;
    rewrite.to = *to;
    rewrites.push_back(std::move(rewrite));
  }
  return rewrites;
}

}  // namespace gmsim::scene
