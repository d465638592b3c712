// SPDX-License-Identifier: MIT
#include "check/statements.h"

#include <algorithm>
#include <map>
#include <utility>

namespace gmsim::check {
using support::DiagnosticKind;
namespace {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};

bool stands_once(std::string_view word) {
  return word == "left" || word == "right" || word == "match" || word == "energy" ||
         word == "value" || word == "first";
}

}  // namespace

std::string_view keyword(const syntax::Statement& statement) {
  using View = std::string_view;
  return std::visit(
      Overloaded{[](const syntax::DimensionStatement&) -> View { return "dimension"; },
                 [](const syntax::SideStatement& side) -> View {
                   switch (side.side) {
                     case syntax::SideKind::Left: return "left";
                     case syntax::SideKind::Right: return "right";
                     case syntax::SideKind::Match: return "match";
                   }
                   return {};
                 },
                 [](const syntax::WhereStatement&) -> View { return "where"; },
                 [](const syntax::ParamStatement&) -> View { return "param"; },
                 [](const syntax::LetStatement&) -> View { return "let"; },
                 [](const syntax::AssignStatement&) -> View { return "assignment"; },
                 [](const syntax::EnergyStatement&) -> View { return "energy"; },
                 [](const syntax::ForceStatement&) -> View { return "force"; },
                 [](const syntax::FirstStatement&) -> View { return "first"; },
                 [](const syntax::ResultStatement&) -> View { return "result"; },
                 [](const syntax::ValueStatement&) -> View { return "value"; },
                 [](const syntax::ForStatement&) -> View { return "for"; },
                 [](const syntax::IfStatement&) -> View { return "if"; },
                 [](const syntax::ApplyStatement&) -> View { return "apply"; }},
      statement.node);
}

Span keyword_span(const syntax::Statement& statement) {
  if (const auto* assign = std::get_if<syntax::AssignStatement>(&statement.node))
    return assign->target ? assign->target->span : statement.span;
  Span span = statement.span;
  const auto length = static_cast<std::uint32_t>(keyword(statement).size());
  span.end = std::min(span.end, span.begin + length);
  return span;
}

void check_statement_kinds(ItemContext& context, const std::vector<syntax::Statement>& body,
                           std::string_view item,
                           std::initializer_list<std::string_view> allowed) {
  std::map<std::string_view, Span> seen;
  for (const syntax::Statement& statement : body) {
    const std::string_view word = keyword(statement);
    const Span place = keyword_span(statement);
    if (std::ranges::find(allowed, word) == allowed.end()) {
      std::string help = "statements here are ";
      for (const auto* at = allowed.begin(); at != allowed.end(); ++at)
        help += (at == allowed.begin() ? "`" : ", `") + std::string(*at) + "`";
      const std::string what = word == "assignment" ? "an assignment" : "`" + std::string(word) + "`";
      context.report({.kind = DiagnosticKind::BadItem,
                      .message = what + " cannot stand in " + std::string(item),
                      .place = place,
                      .help = std::move(help)});
      continue;
    }
    if (!stands_once(word)) continue;
    const auto [first, added] = seen.emplace(word, place);
    if (!added)
      context.report({.kind = DiagnosticKind::Conflict,
                      .message = "a second `" + std::string(word) + "`",
                      .place = place,
                      .related = {{first->second, "the first one"}}});
  }
}

const syntax::SideStatement* find_side(const std::vector<syntax::Statement>& body,
                                       syntax::SideKind side) {
  for (const syntax::Statement& statement : body)
    if (const auto* found = std::get_if<syntax::SideStatement>(&statement.node);
        found && found->side == side)
      return found;
  return nullptr;
}

void reject_behaviour(ItemContext& context, const syntax::ParamStatement& statement) {
  const bool kind = statement.kind.kind != syntax::KindClause::Kind::None;
  if (!kind && !statement.merge) return;
  context.report({.kind = DiagnosticKind::BadItem,
                  .message = "only the parameters of interactions are stored, split and merged",
                  .place = kind ? statement.kind.span : statement.merge->policy.span});
}

Parameter check_parameter(ItemContext& context, const syntax::ParamStatement& statement,
                          const std::vector<Step>& steps) {
  Parameter parameter{.name = statement.name.text, .type = {}, .unit = {}, .slot = {},
                      .default_value = nullptr, .embedding = {}, .span = statement.name.span};
  const auto type = resolve_type(context, statement.type);
  if (type) {
    parameter.type = type->type;
    parameter.unit = type->unit;
    parameter.unit_scale = type->scale;
  } else {
    context.poison();
  }
  if (statement.default_value && type) {
    ExprChecker checker(context);
    const ExprPtr value = checker.check_as(
        statement.default_value,
        {.type = type->type, .unit = type->unit, .scale = type->scale,
         .what = "parameter `" + statement.name.text + "`"});
    parameter.default_value = close_over(value, steps);
  }
  parameter.slot = context
                       .declare_slot(statement.name, Binding::Kind::Parameter, parameter.type,
                                     parameter.unit, parameter.unit_scale)
                       ->slot;
  return parameter;
}

void declare_nodes(ItemContext& context, Pattern& pattern) {
  for (PatternNode& node : pattern.nodes)
    node.slot = context
                    .declare_slot({node.name, node.span}, Binding::Kind::Node, {ValueKind::Dart})
                    ->slot;
}

Result check_result(ItemContext& context, const syntax::ResultStatement& statement) {
  Result result{.name = statement.name.text, .type = {}, .unit = {}, .embedding = {}, .slot = {},
                .value = nullptr, .span = statement.name.span};
  ExprChecker checker(context);
  if (statement.type) {
    const auto type = resolve_type(context, *statement.type);
    if (!type) context.poison();
    if (type) {
      result.value = checker.check_as(
          statement.value, {.type = type->type, .unit = type->unit, .scale = type->scale,
                            .what = "result `" + statement.name.text + "`"});
      result.type = type->type;
      result.unit = type->unit ? type->unit : result.value->unit;
    }
  } else {
    result.value = settle(checker.check(statement.value));
    if (!is_error(result.value) && !is_storable(result.value->type))
      context.report({.kind = DiagnosticKind::TypeMismatch,
                      .message = "a result cannot be " + found_text(result.value),
                      .place = result.value->span});
    result.type = result.value->type;
    result.unit = result.value->unit;
  }
  result.slot =
      context.declare_slot(statement.name, Binding::Kind::Let, result.type, result.unit)->slot;
  return result;
}

void fill_head(ItemHead& head, const ItemContext& context, const ItemEntry& entry) {
  head.name = entry.name->text;
  head.doc = entry.item->doc;
  head.name_span = entry.name->span;
  head.span = entry.item->span;
  head.dimension = context.n();
  head.from_library = entry.library;
  head.frame_size = static_cast<std::uint32_t>(context.slot_names.size());
  head.slot_names = context.slot_names;
}

}  // namespace gmsim::check
