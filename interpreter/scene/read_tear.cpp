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
std::optional<engine::DartExpression> condition(const YamlNode& section, ReadContext& context) {
  const YamlNode* node = section.find("where");
  const SceneExpression where = context.where(section);
  if (!where.good() || (node != nullptr && node->is_default)) return std::nullopt;
  return where.code;
}

class TearReader {
 public:
  TearReader(const YamlNode& section, ReadContext& context)
      : section_(section), context_(context), program_(context.program) {}

  std::optional<engine::TearPairing> read() {
    const YamlNode* action = section_.find("do");
    const auto change =
        action ? read_change(*action, context_) : std::optional<engine::NamedChange>{};
    tear_.where = condition(section_, context_);
    if (!find_criterion()) return std::nullopt;
    read_threshold();
    tear_.after = context_.number(*section_.find("after"));
    tear_.refresh = section_.find("refresh")->text == "true";
    if (const YamlNode* at_most = section_.find("at_most"))
      tear_.at_most = static_cast<std::uint32_t>(context_.number(*at_most));
    read_nodes();
    if (!change) return std::nullopt;
    tear_.change = *change;
    read_arguments(action->span);
    (void)read_candidates(section_, *change, action->span, context_);
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

  [[nodiscard]] const compile::RootedPattern& criterion() const {
    return program_.criteria[tear_.criterion];
  }

  /// `threshold`, in the unit of the criterion's value; it must be positive.
  void read_threshold() {
    const compile::Parameter* parameter = criterion().find_parameter("threshold");
    const YamlNode* node = section_.find("threshold");
    if (parameter == nullptr || node == nullptr) return;
    const auto& declared = context_.library().criteria[tear_.criterion].parameters;
    const auto threshold = std::ranges::find(declared, "threshold", &check::Parameter::name);
    const double scale = threshold == declared.end() ? 1.0 : threshold->unit_scale;
    const SceneExpression value = context_.expression(
        *node, {.type = parameter->type, .unit = parameter->unit, .unit_scale = scale});
    tear_.threshold = parameter->slot;
    tear_.parameters.push_back({parameter->slot, value.code});
    if (!value.good() || !value.constant) return;
    const auto constant = context_.constant(value, "`threshold`");
    if (constant && constant->as_real() > 0) return;
    context_.report(DiagnosticKind::OutOfRange, node->span, "a threshold must be above 0");
  }

  void read_nodes() {
    const auto& nodes = criterion().match.nodes;
    const YamlNode* at = section_.find("at");
    if (at == nullptr) {
      tear_.at.push_back(criterion().match.hooks.at(0));
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

  /// Parameters of the change: from the scene, or else from the criterion's results by name.
  void read_arguments(support::Span span) {
    std::vector<const compile::Parameter*> given;
    for (auto& [parameter, value] :
         read_parameters(section_.find("params"), tear_.change, context_)) {
      given.push_back(parameter);
      tear_.arguments.push_back({parameter->slot, std::nullopt, value.code});
    }
    const auto& results = program_.criterion_bodies[tear_.criterion].results;
    const auto& parameters = tear_.change.operation
                                 ? program_.operations[tear_.change.target].parameters
                                 : program_.rules[tear_.change.target].parameters;
    for (const compile::Parameter& parameter : parameters) {
      const auto result = std::ranges::find(results, parameter.name, &compile::BodyResult::name);
      if (result == results.end() || std::ranges::find(given, &parameter) != given.end()) continue;
      given.push_back(&parameter);
      tear_.arguments.push_back(
          {parameter.slot, static_cast<std::uint32_t>(result - results.begin()), {}});
    }
    require_parameters(given, tear_.change, span, context_);
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
                                    .where = condition(section, context),
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
