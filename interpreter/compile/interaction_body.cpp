// SPDX-License-Identifier: MIT
#include "compile/interaction_body.h"

#include <utility>

#include "check/checked_rule.h"
#include "compile/compile.h"

namespace gmsim::compile {

namespace {

void fill_body(ItemBody& body, const check::ItemHead& item, const check::Pattern& match,
               const std::vector<check::Parameter>& parameters,
               const std::vector<check::Step>& steps, const std::vector<check::Result>& results) {
  body.name = item.name;
  body.name_span = item.name_span;
  body.from_library = item.from_library;
  body.frame_size = item.frame_size;
  body.slot_names = item.slot_names;
  for (const check::PatternNode& node : match.nodes) body.nodes.push_back(node.slot);
  for (const check::Parameter& parameter : parameters) {
    body.parameters.push_back({parameter.name, parameter.type, parameter.unit, parameter.slot,
                               parameter.embedding, parameter.default_value, parameter.span});
  }
  for (const check::Step& step : steps) {
    const bool let = step.kind == check::Step::Kind::Let;
    body.steps.push_back({let ? BodyStep::Kind::Let : BodyStep::Kind::Where, step.slot, step.value});
  }
  for (const check::Result& result : results) {
    body.results.push_back({result.name, result.type, result.unit, result.embedding, result.slot,
                            result.value, result.span});
  }
}

}  // namespace

InteractionBody compile_body(const check::Interaction& interaction) {
  InteractionBody body;
  fill_body(body, interaction, interaction.match, interaction.parameters, interaction.steps,
            interaction.results);
  body.orbit = interaction.orbit;
  body.dart = interaction.dart;
  body.hook = interaction.hook;
  body.id = interaction.id;
  body.external = interaction.external;
  body.presence = interaction.presence;
  body.energy = interaction.energy;
  for (const check::ForceLine& line : interaction.forces) {
    body.forces.push_back({line.targets, line.collection, line.variable, line.orbit, line.value,
                           line.span});
  }
  return body;
}

CriterionBody compile_body(const check::Criterion& criterion) {
  CriterionBody body;
  fill_body(body, criterion, criterion.match, criterion.parameters, criterion.steps,
            criterion.results);
  body.orbit = criterion.orbit;
  body.dart = criterion.dart;
  body.hook = criterion.hook;
  body.interaction = criterion.interaction;
  body.value = criterion.value;
  if (criterion.change)
    body.change = {criterion.change->operation, criterion.change->target, criterion.change->node};
  return body;
}

ItemBody expression_body(std::string name, OrbitType orbit, Slot dart, std::uint32_t frame_size) {
  ItemBody body;
  body.name = std::move(name);
  body.orbit = orbit;
  body.dart = dart;
  body.nodes = {dart};
  body.frame_size = frame_size;
  return body;
}

}  // namespace gmsim::compile
