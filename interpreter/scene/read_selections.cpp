// SPDX-License-Identifier: MIT
#include "scene/quantity.h"
#include "scene/read_context.h"

namespace gmsim::scene {
namespace {

using support::DiagnosticKind;

Selection read_selection(const YamlNode& section, ReadContext& context) {
  Selection selection{
      .body = context.body(section), .where = context.where(section), .span = section.span};
  if (const YamlEntry* where = section.find_entry("where"); where && !where->value.is_default)
    selection.span = where->value.span;
  return selection;
}

engine::OnSplit on_split(const YamlNode& node) {
  if (node.text == "keep_first") return engine::OnSplit::KeepFirst;
  return node.text == "release" ? engine::OnSplit::Release : engine::OnSplit::Both;
}

void read_move(const YamlNode& section, ReadContext& context, ScenePlan& plan) {
  const YamlNode* velocity = section.find("velocity");
  const YamlNode* position = section.find("position");
  MovePlan move{.vertices = read_selection(section, context),
                .gives_position = position != nullptr,
                .value = {}};
  if ((velocity != nullptr) == (position != nullptr)) {
    context.report(velocity ? DiagnosticKind::Conflict : DiagnosticKind::MissingKey, section.span,
                   velocity ? "a motion is given by `velocity` and by `position`"
                            : "this does not say how the vertices move",
                   "give one of `velocity` and `position`");
    return;
  }
  move.value = context.expression(
      position ? *position : *velocity,
      {.type = {types::ValueKind::Vec3}, .unit = schema_unit(position ? "m" : "m/s")});
  plan.moves.push_back(std::move(move));
}

}  // namespace

void read_selections(const YamlNode& scene, ReadContext& context, ScenePlan& plan) {
  for (const YamlNode& section : scene.find("fix")->items)
    plan.fixes.push_back({read_selection(section, context), on_split(*section.find("on_split"))});
  for (const YamlNode& section : scene.find("move")->items) read_move(section, context, plan);
}

}  // namespace gmsim::scene
