// SPDX-License-Identifier: MIT
// Interactions: pattern, parameters, energy, forces, results; and families of them.
#include <algorithm>
#include <utility>

#include "check/build_pattern.h"
#include "check/check_expr.h"
#include "check/force_coverage.h"
#include "check/item_checks.h"
#include "check/passes.h"
#include "check/statements.h"
#include "check/value_kinds.h"
#include "support/suggest.h"

namespace gmsim::check {
using gmap::EmbeddingDecl;
using gmap::EmbeddingRole;
using support::DiagnosticKind;
namespace {

const syntax::InteractionItem& item_of(const InteractionDraft& draft) {
  const ItemEntry& entry = (*draft.context.env.items)[draft.item];
  return std::get<syntax::InteractionItem>(entry.item->node);
}

types::Unit unit_named(const char* name) { return types::named_unit(name)->unit; }

EmbeddingDecl value_of(const InteractionDraft& draft, const syntax::Name& name,
                       EmbeddingRole role) {
  EmbeddingDecl value;
  value.name = item_of(draft).name.text + "." + name.text;
  value.orbit = draft.result.orbit;
  value.role = role;
  value.optional = true;
  value.span = name.span;
  return value;
}

void set_type(ItemContext& context, const syntax::TypeExpr& type, EmbeddingDecl& value) {
  if (const auto resolved = resolve_type(context, type)) {
    value.type = resolved->type;
    value.unit = resolved->unit;
    value.unit_scale = resolved->scale;
  } else {
    context.poison();
  }
}

/// The mark that an orbit carries the interaction, then parameters and results in order.
void declare_stored(InteractionDraft& draft) {
  const syntax::InteractionItem& item = item_of(draft);
  EmbeddingDecl presence;
  presence.name = item.name.text;
  presence.type = {ValueKind::Bool};
  presence.orbit = draft.result.orbit;
  presence.role = EmbeddingRole::Presence;
  presence.optional = true;
  presence.span = item.name.span;
  draft.values.push_back(std::move(presence));
  for (const syntax::Statement& statement : item.body) {
    if (const auto* param = std::get_if<syntax::ParamStatement>(&statement.node)) {
      EmbeddingDecl value = value_of(draft, param->name, EmbeddingRole::Parameter);
      set_type(draft.context, param->type, value);
      const ValueBehaviour behaviour =
          resolve_behaviour(draft.context, param->kind, param->merge,
                            {value.type, value.unit, value.unit_scale});
      value.kind = behaviour.kind;
      value.merge = behaviour.merge;
      draft.values.push_back(std::move(value));
    }
    if (const auto* result = std::get_if<syntax::ResultStatement>(&statement.node)) {
      EmbeddingDecl value = value_of(draft, result->name, EmbeddingRole::Result);
      value.kind = gmap::EmbeddingKind::Derived;
      if (result->type) {
        set_type(draft.context, *result->type, value);
      } else {
        draft.context.report({.kind = DiagnosticKind::BadItem,
                              .message = "the result of an interaction needs a type",
                              .place = result->name.span,
                              .help = "write `result " + result->name.text +
                                      " : real [J] = …;`"});
      }
      draft.values.push_back(std::move(value));
    }
  }
}

void build_match(InteractionDraft& draft) {
  const syntax::InteractionItem& item = item_of(draft);
  Interaction& result = draft.result;
  PatternBuilder builder(draft.context, syntax::SideKind::Match);
  const auto* match = find_side(item.body, syntax::SideKind::Match);
  if (match)
    builder.add(match->block);
  else
    builder.add_node(item.dart);
  result.match = builder.take();
  declare_nodes(draft.context, result.match);
  const auto hook = result.match.find(item.dart.text);
  if (!hook) {
    if (draft.context.good())
      draft.context.report({.kind = DiagnosticKind::BadItem,
                            .message = "`match` does not name `" + item.dart.text +
                                       "`, the dart that the interaction is on",
                            .place = item.dart.span,
                            .related = {{match->block.span, "the pattern"}}});
    return;
  }
  result.hook = *hook;
  result.dart = result.match.nodes[*hook].slot;
  if (draft.context.good())
    check_match(result.match, result.hook, draft.context.n(), draft.context.diagnostics);
}

/// The statements of a body whose names and pattern are known.
class InteractionBody {
 public:
  InteractionBody(InteractionDraft& draft, EmbeddingId first_value)
      : draft_(draft), context_(draft.context), item_(item_of(draft)), result_(draft.result),
        next_value_(types::index(first_value)) {}

  void run() {
    context_.allow_forces = false;
    result_.presence = EmbeddingId{next_value_++};
    for (const syntax::Statement& statement : item_.body) add(statement);
    if (!context_.good()) return;
    const bool gives_force = std::ranges::any_of(
        result_.forces, [](const ForceLine& line) { return line.value != nullptr; });
    if (!result_.energy && !gives_force)
      context_.report({.kind = DiagnosticKind::BadItem,
                       .message = "interaction `" + item_.name.text +
                                  "` gives neither an energy nor a force",
                       .place = item_.name.span});
    if (context_.good()) check_forces_start_somewhere(result_, context_);
    if (context_.good()) check_force_coverage(result_, context_);
  }

 private:
  void add(const syntax::Statement& statement) {
    if (context_.absence) return;
    ExprChecker checker(context_);
    if (const auto* param = std::get_if<syntax::ParamStatement>(&statement.node)) {
      const EmbeddingId stored{next_value_++};
      Parameter parameter = check_parameter(context_, *param, result_.steps);
      parameter.embedding = stored;
      result_.parameters.push_back(std::move(parameter));
      check_weight(context_.env, context_.sources, param->kind, item_.dart,
                   context_.env.library->schema[stored], context_);
    }
    if (const auto* let = std::get_if<syntax::LetStatement>(&statement.node))
      if (auto step = checker.check_let(*let, statement.span, true))
        result_.steps.push_back(*step);
    if (const auto* where = std::get_if<syntax::WhereStatement>(&statement.node))
      result_.steps.push_back(
          {Step::Kind::Where, {}, checker.check_condition(where->condition, "`where`")});
    if (const auto* first = std::get_if<syntax::FirstStatement>(&statement.node)) add_first(*first);
    if (const auto* energy = std::get_if<syntax::EnergyStatement>(&statement.node))
      result_.energy = checker.check_as(
          energy->value,
          {.type = {ValueKind::Real}, .unit = unit_named("J"), .what = "an energy"});
    if (const auto* force = std::get_if<syntax::ForceStatement>(&statement.node))
      add_force(*force, statement.span);
    if (const auto* result = std::get_if<syntax::ResultStatement>(&statement.node)) {
      result_.results.push_back(check_result(context_, *result));
      result_.results.back().embedding = EmbeddingId{next_value_++};
    }
  }

  /// `first d where …`: `d` is the dart at which the pattern is tried, the binder itself or a name for
  /// the condition only.
  void add_first(const syntax::FirstStatement& first) {
    const std::size_t outer = context_.scope.size();
    result_.first_dart = result_.dart;
    if (first.name.text != item_.dart.text)
      result_.first_dart =
          context_.declare_slot(first.name, Binding::Kind::Node, {ValueKind::Dart})->slot;
    ExprChecker checker(context_);
    const ExprPtr condition = checker.check_condition(first.condition, "`first … where`");
    result_.first = close_over(condition, result_.steps);
    context_.scope.shrink(outer);
  }

  void add_force(const syntax::ForceStatement& force, Span span) {
    ForceLine line{.targets = {}, .collection = nullptr, .variable = {}, .orbit = {},
                   .value = nullptr, .span = span};
    ExprChecker checker(context_);
    const std::size_t outer = context_.scope.size();
    if (force.collection) {
      line.collection = checker.check_collection(force.collection);
      if (!is_error(line.collection) && !has_kind(line.collection, ValueKind::Darts))
        context_.report({.kind = DiagnosticKind::TypeMismatch,
                         .message = "`force … in` needs a collection of darts",
                         .place = line.collection->span});
      const ExprPtr variable = checker.declare_variable(force.targets.at(0), line.collection);
      line.variable = variable->slot;
      line.targets = {variable};
    } else {
      for (const syntax::Name& target : force.targets) add_target(target, line);
    }
    if (const auto orbit = resolve_orbit(context_, force.orbit)) {
      line.orbit = *orbit;
      check_orbit(*orbit, force.orbit.span);
    }
    if (force.value)
      line.value = checker.check_as(
          force.value, {.type = {ValueKind::Vec3}, .unit = unit_named("N"), .what = "a force"});
    context_.scope.shrink(outer);
    result_.forces.push_back(std::move(line));
  }

  void add_target(const syntax::Name& name, ForceLine& line) {
    const Binding* binding = context_.scope.find(name.text);
    if (binding && binding->value && has_kind(binding->value, ValueKind::Dart)) {
      line.targets.push_back(with_span(binding->value, name.span));
      return;
    }
    if (binding && binding->value && is_error(binding->value)) return context_.poison();
    if (binding) {
      context_.report({.kind = DiagnosticKind::TypeMismatch,
                       .message = "a force acts on a node, `" + name.text + "` is none",
                       .place = name.span});
      return;
    }
    std::vector<std::string> nodes;
    for (const Binding& known : context_.scope.bindings())
      if (known.value && has_kind(known.value, ValueKind::Dart)) nodes.push_back(known.name);
    context_.report({.kind = DiagnosticKind::UnknownName,
                     .message = "the pattern has no node `" + name.text + "`",
                     .place = name.span,
                     .help = support::did_you_mean(name.text, nodes)});
  }

  void check_orbit(OrbitType orbit, Span place) {
    const int n = context_.n();
    const OrbitType vertex = OrbitType::cell(0, n);
    if (vertex.contains(orbit)) return;
    context_.report({.kind = DiagnosticKind::ForceOrbit,
                     .message = "an atomic force lives on an orbit inside `vertex` " +
                                to_string(vertex) + ", " + to_string(orbit) + " is not",
                     .place = place,
                     .help = "`dart`, `corner` and `vertex` are inside"});
  }

  InteractionDraft& draft_;
  ItemContext& context_;
  const syntax::InteractionItem& item_;
  Interaction& result_;
  std::uint32_t next_value_;
};

}  // namespace

void declare_interaction(InteractionDraft& draft) {
  const syntax::InteractionItem& item = item_of(draft);
  draft.result.external = item.external;
  draft.result.name = item.name.text;
  check_statement_kinds(draft.context, item.body, "an interaction",
                        {"dimension", "match", "param", "let", "where", "first", "energy",
                         "force", "result"});
  if (const auto orbit = resolve_orbit(draft.context, item.orbit)) draft.result.orbit = *orbit;
  build_match(draft);
  if (!draft.context.absence) declare_stored(draft);
}

void complete_interaction(InteractionDraft& draft, EmbeddingId first_value) {
  InteractionBody(draft, first_value).run();
  fill_head(draft.result, draft.context, (*draft.context.env.items)[draft.item]);
}

Family check_family(ItemContext& context, const ItemEntry& entry) {
  const auto& item = std::get<syntax::FamilyItem>(entry.item->node);
  Family family{.name = item.name.text, .doc = entry.item->doc, .name_span = item.name.span,
                .members = {}};
  const ItemTable& items = *context.env.items;
  const std::vector<Interaction>& interactions = context.env.library->interactions;
  for (const syntax::Name& member : item.members) {
    const auto found = context.env.values.find(member.text);
    if (found != context.env.values.end() &&
        std::holds_alternative<InteractionId>(found->second)) {
      const InteractionId id = std::get<InteractionId>(found->second);
      if (std::ranges::count(family.members, id) > 0)
        context.report({.kind = DiagnosticKind::DuplicateName,
                        .message = "`" + member.text + "` is a member already",
                        .place = member.span});
      else if (!family.members.empty() &&
               interactions[types::index(family.members[0])].orbit !=
                   interactions[types::index(id)].orbit)
        context.report({.kind = DiagnosticKind::Conflict,
                        .message = "the members of a family are on one orbit; `" + member.text +
                                   "` is on " +
                                   to_string(interactions[types::index(id)].orbit),
                        .place = member.span});
      else
        family.members.push_back(id);
      continue;
    }
    const auto other = items.find_any(NameSpace::Values, member.text);
    if (other && items[*other].kind == ItemKind::Interaction) {
      // A member that this dimension lacks is left out; one that failed silences the family.
      if (context.env.states[*other].status == ItemStatus::Failed) context.poison();
      continue;
    }
    context.report_unknown(
        {.kind = DiagnosticKind::UnknownItem,
         .message = other ? "`" + member.text + "` is " + with_article(items[*other].kind) +
                                ", not an interaction"
                          : "no interaction named `" + member.text + "`",
         .place = member.span,
         .help = support::did_you_mean(member.text, items.names(NameSpace::Values))});
  }
  if (family.members.empty() && context.good())
    context.absent(DiagnosticKind::Dimension, item.name.span,
                   "no member of family `" + item.name.text + "` exists in dimension " +
                       std::to_string(context.n()));
  return family;
}

}  // namespace gmsim::check
