// SPDX-License-Identifier: MIT
#include "check/item_parts.h"

#include <string>

#include "types/orbit_type.h"

namespace gmsim::check {
using support::DiagnosticKind;
namespace {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};

void choose(DimensionChoice& choice, const syntax::DimensionStatement& statement,
            support::Diagnostics& diagnostics) {
  if (statement.dimension < 1 || statement.dimension > types::kMaxDimension) {
    diagnostics.report({.kind = DiagnosticKind::Dimension,
                        .message = "a map has dimension 1, 2 or 3",
                        .place = statement.span});
    return;
  }
  if (choice.dimension && *choice.dimension != statement.dimension) {
    diagnostics.report({.kind = DiagnosticKind::Conflict,
                        .message = "`dimension " + std::to_string(statement.dimension) +
                                   ";` contradicts `dimension " +
                                   std::to_string(*choice.dimension) + ";`",
                        .place = statement.span,
                        .related = {{choice.span, "said here"}}});
    return;
  }
  choice = {statement.dimension, statement.span};
}

void choose(DimensionChoice& choice, const syntax::PatternBlock& block,
            support::Diagnostics& diagnostics) {
  for (const syntax::PatternStatement& statement : block.statements)
    if (const auto* said = std::get_if<syntax::DimensionStatement>(&statement.node))
      choose(choice, *said, diagnostics);
}

}  // namespace

std::optional<std::pair<ItemKind, const syntax::Name*>> item_name(const syntax::Item& item) {
  using Part = std::optional<std::pair<ItemKind, const syntax::Name*>>;
  return std::visit(
      Overloaded{
          [](const syntax::ImportItem&) -> Part { return std::nullopt; },
          [](const syntax::DimensionStatement&) -> Part { return std::nullopt; },
          [](const syntax::OrbitItem& i) -> Part { return {{ItemKind::Orbit, &i.name}}; },
          [](const syntax::EmbeddingItem& i) -> Part { return {{ItemKind::Embedding, &i.name}}; },
          [](const syntax::DerivedItem& i) -> Part { return {{ItemKind::Derived, &i.name}}; },
          [](const syntax::FunctionItem& i) -> Part { return {{ItemKind::Function, &i.name}}; },
          [](const syntax::PatternItem& i) -> Part { return {{ItemKind::Pattern, &i.name}}; },
          [](const syntax::RuleItem& i) -> Part { return {{ItemKind::Rule, &i.name}}; },
          [](const syntax::InteractionItem& i) -> Part {
            return {{ItemKind::Interaction, &i.name}};
          },
          [](const syntax::FamilyItem& i) -> Part { return {{ItemKind::Family, &i.name}}; },
          [](const syntax::CriterionItem& i) -> Part { return {{ItemKind::Criterion, &i.name}}; },
          [](const syntax::OperationItem& i) -> Part {
            return {{ItemKind::Operation, &i.name}};
          }},
      item.node);
}

const std::vector<syntax::Statement>* item_body(const syntax::Item& item) {
  if (const auto* rule = std::get_if<syntax::RuleItem>(&item.node)) return &rule->body;
  if (const auto* law = std::get_if<syntax::InteractionItem>(&item.node)) return &law->body;
  if (const auto* criterion = std::get_if<syntax::CriterionItem>(&item.node))
    return &criterion->body;
  if (const auto* operation = std::get_if<syntax::OperationItem>(&item.node))
    return &operation->body;
  return nullptr;
}

DimensionChoice file_dimension(const syntax::RuleFile& file, support::Diagnostics& diagnostics) {
  DimensionChoice choice;
  for (const syntax::Item& item : file.items)
    if (const auto* said = std::get_if<syntax::DimensionStatement>(&item.node))
      choose(choice, *said, diagnostics);
  return choice;
}

DimensionChoice item_dimension(const syntax::Item& item, const DimensionChoice& whole_file,
                               support::Diagnostics& diagnostics) {
  DimensionChoice choice = whole_file;
  if (const auto* body = item_body(item))
    for (const syntax::Statement& statement : *body) {
      if (const auto* said = std::get_if<syntax::DimensionStatement>(&statement.node))
        choose(choice, *said, diagnostics);
      if (const auto* side = std::get_if<syntax::SideStatement>(&statement.node))
        choose(choice, side->block, diagnostics);
    }
  if (const auto* pattern = std::get_if<syntax::PatternItem>(&item.node))
    choose(choice, pattern->block, diagnostics);
  return choice;
}

}  // namespace gmsim::check
