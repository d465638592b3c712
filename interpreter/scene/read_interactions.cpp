// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "scene/read_context.h"
#include "support/suggest.h"

namespace gmsim::scene {
namespace {

using support::DiagnosticKind;

std::string type_text(const check::Parameter& parameter) {
  return types::to_string(parameter.type) +
         (parameter.unit ? " [" + types::to_string(*parameter.unit) + "]" : "");
}

class InteractionReader {
 public:
  explicit InteractionReader(ReadContext& context)
      : context_(context), library_(context.library()) {}

  /// `NAME: { parameter: value, …, where: … }`.
  std::optional<InteractionUse> read(const YamlEntry& entry, std::optional<std::size_t> body) {
    InteractionUse use{.name = entry.key, .body = body, .span = entry.key_span};
    if (!find_members(use)) return std::nullopt;
    if (!body) use.body = context_.body(entry.value);
    use.where = context_.where(entry.value);
    for (const YamlEntry& value : entry.value.entries) {
      if (value.key == "where" || (value.key == "body" && !body)) continue;
      read_parameter(value, use);
    }
    for (const InteractionUse::Member& member : use.members) require_parameters(member, use);
    return use;
  }

 private:
  [[nodiscard]] const check::Interaction& item(const InteractionUse::Member& member) const {
    return library_.interactions[member.interaction];
  }

  bool find_members(InteractionUse& use) {
    if (const check::Interaction* interaction = library_.find_interaction(use.name)) {
      use.members.push_back({types::index(interaction->id), {}});
      return true;
    }
    if (const check::Family* family = library_.find_family(use.name)) {
      use.family = true;
      for (const types::InteractionId id : family->members)
        use.members.push_back({types::index(id), {}});
      return true;
    }
    std::vector<std::string> names = names_of(library_.interactions);
    const std::vector<std::string> families = names_of(library_.families);
    names.insert(names.end(), families.begin(), families.end());
    context_.report_unknown_item(use.name, use.span, "interaction or family", names);
    return false;
  }

  /// A family's parameter goes to each member that has it.
  void read_parameter(const YamlEntry& entry, InteractionUse& use) {
    bool known = false;
    for (InteractionUse::Member& member : use.members) {
      const auto& parameters = item(member).parameters;
      const auto parameter = std::ranges::find(parameters, entry.key, &check::Parameter::name);
      if (parameter == parameters.end()) continue;
      known = true;
      member.given.push_back(
          {static_cast<std::uint32_t>(parameter - parameters.begin()),
           context_.expression(entry.value, {.type = parameter->type,
                                             .unit = parameter->unit,
                                             .unit_scale = parameter->unit_scale})});
    }
    if (!known) report_unknown(entry, use);
  }

  void report_unknown(const YamlEntry& entry, const InteractionUse& use) {
    std::vector<std::string> names = {"where"};
    for (const InteractionUse::Member& member : use.members)
      for (const check::Parameter& parameter : item(member).parameters)
        if (std::ranges::find(names, parameter.name) == names.end())
          names.push_back(parameter.name);
    const std::string guess = support::did_you_mean(entry.key, names);
    names.erase(names.begin());
    std::string help = guess;
    if (help.empty())
      help = names.empty() ? "it has none"
                           : fmt::format("its parameters are `{}`", fmt::join(names, "`, `"));
    context_.report(DiagnosticKind::UnknownName, entry.key_span,
                    fmt::format("`{}` has no parameter `{}`", use.name, entry.key),
                    std::move(help));
  }

  void require_parameters(const InteractionUse::Member& member, const InteractionUse& use) {
    const auto& parameters = item(member).parameters;
    for (std::uint32_t i = 0; i < parameters.size(); ++i) {
      const bool given =
          std::ranges::find(member.given, i, &GivenParameter::parameter) != member.given.end();
      if (given || parameters[i].default_value) continue;
      context_.report(DiagnosticKind::MissingKey, use.span,
                      fmt::format("`{}` needs its parameter `{}`", use.name, parameters[i].name),
                      fmt::format("`{}` is a {}", parameters[i].name, type_text(parameters[i])));
    }
  }

  ReadContext& context_;
  const check::RuleLibrary& library_;
};

/// `gravity: [0, 0, -9.81]` is the library's interaction of that name, with its parameter `g`.
std::optional<YamlEntry> as_load(const YamlNode& scene) {
  const YamlEntry* gravity = scene.find_entry("gravity");
  if (gravity == nullptr || gravity->value.is_null()) return std::nullopt;
  YamlEntry load{"gravity", gravity->key_span, {}};
  load.value.kind = YamlNode::Kind::Map;
  load.value.span = gravity->value.span;
  load.value.entries.push_back({"g", gravity->key_span, gravity->value});
  YamlNode everywhere = YamlNode::scalar("true", gravity->key_span);
  everywhere.exact = false;
  load.value.entries.push_back({"where", gravity->key_span, std::move(everywhere)});
  return load;
}

}  // namespace

void read_interactions(const YamlNode& scene, ReadContext& context, ScenePlan& plan) {
  InteractionReader reader(context);
  const auto add = [&](const YamlEntry& entry, std::optional<std::size_t> body) {
    if (auto use = reader.read(entry, body)) plan.interactions.push_back(std::move(*use));
  };
  if (const YamlNode* bodies = scene.find("bodies"))
    for (std::size_t body = 0; body < bodies->items.size(); ++body)
      for (const YamlEntry& entry : bodies->items[body].find("interactions")->entries)
        add(entry, body);
  if (const auto gravity = as_load(scene)) add(*gravity, std::nullopt);
  for (const YamlNode& load : scene.find("loads")->items)
    for (const YamlEntry& entry : load.entries) add(entry, std::nullopt);
}

}  // namespace gmsim::scene
