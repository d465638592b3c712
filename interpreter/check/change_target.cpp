// SPDX-License-Identifier: MIT
#include "check/change_target.h"

#include <string>

#include "support/suggest.h"

namespace gmsim::check {
using support::DiagnosticKind;
namespace {

void report_unknown(ItemContext& context, const syntax::Name& name) {
  const ItemTable& items = *context.env.items;
  for (const NameSpace space : {NameSpace::Rules, NameSpace::Operations})
    if (const auto other = items.find_any(space, name.text); other && items[*other].dimension) {
      context.absent(DiagnosticKind::Dimension, name.span,
                     std::string(noun(items[*other].kind)) + " `" + name.text +
                         "` says `dimension " + std::to_string(*items[*other].dimension) + ";`");
      return;
    }
  std::vector<std::string> names = items.names(NameSpace::Rules);
  for (const std::string& operation : items.names(NameSpace::Operations))
    names.push_back(operation);
  context.report_unknown({.kind = DiagnosticKind::UnknownItem,
                          .message = "no rule or operation named `" + name.text + "`",
                          .place = name.span,
                          .help = support::did_you_mean(name.text, names)});
}

/// Whether an item can be looked up in the library; reports why not.
bool is_checked(ItemContext& context, ItemIndex item, const syntax::Name& name) {
  if (context.env.states[item].status == ItemStatus::InProgress) {
    context.report({.kind = DiagnosticKind::RecursiveDefinition,
                    .message = "operation `" + name.text + "` applies itself",
                    .place = name.span});
    return false;
  }
  if (!context.require(item, name.span)) return false;
  if (context.env.states[item].status != ItemStatus::Unchecked) return true;
  context.report({.kind = DiagnosticKind::TooDeep,
                  .message = "operations apply operations too deep",
                  .place = name.span});
  return false;
}

}  // namespace

std::optional<ChangeTarget> find_change(ItemContext& context, const syntax::Name& name) {
  const RuleLibrary& library = *context.env.library;
  for (const NameSpace space : {NameSpace::Rules, NameSpace::Operations}) {
    const auto item = context.env.items->find(space, name.text, context.n());
    if (!item) continue;
    if (!is_checked(context, *item, name)) return std::nullopt;
    if (const Rule* rule = library.find_rule(name.text); rule && space == NameSpace::Rules)
      return ChangeTarget{false, static_cast<std::uint32_t>(rule - library.rules.data()),
                          rule->hooks.size(), &rule->parameters, rule->name_span};
    if (const Operation* operation = library.find_operation(name.text))
      return ChangeTarget{true,
                          static_cast<std::uint32_t>(operation - library.operations.data()), 1,
                          &operation->parameters, operation->name_span};
  }
  report_unknown(context, name);
  return std::nullopt;
}

}  // namespace gmsim::check
