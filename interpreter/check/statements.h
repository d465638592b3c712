// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <string_view>
#include <vector>

#include "check/check_expr.h"
#include "check/item_context.h"

/// What the bodies of rules, interactions, criteria and operations have in common.
namespace gmsim::check {

/// The word a statement begins with; "assignment" for an assignment.
[[nodiscard]] std::string_view keyword(const syntax::Statement& statement);
/// Where that word stands.
[[nodiscard]] Span keyword_span(const syntax::Statement& statement);

/// Reports statements that are not among `allowed`, and second ones of those that stand once.
void check_statement_kinds(ItemContext& context, const std::vector<syntax::Statement>& body,
                           std::string_view item, std::initializer_list<std::string_view> allowed);

/// The block of `left`, `right` or `match`; null without one.
[[nodiscard]] const syntax::SideStatement* find_side(const std::vector<syntax::Statement>& body,
                                                     syntax::SideKind side);

/// Declares a parameter with a slot of its own; its default reads what is above it.
/// `steps`: the lets above, which become part of the default.
Parameter check_parameter(ItemContext& context, const syntax::ParamStatement& statement,
                          const std::vector<Step>& steps);
/// The clauses about splits and merges make sense where a parameter is stored only.
void reject_behaviour(ItemContext& context, const syntax::ParamStatement& statement);

/// Gives every node of a pattern a slot and a name in the scope.
void declare_nodes(ItemContext& context, Pattern& pattern);

/// `result r [: type] = EXPR;`
Result check_result(ItemContext& context, const syntax::ResultStatement& statement);

/// Name, places and frame of a checked item.
void fill_head(ItemHead& head, const ItemContext& context, const ItemEntry& entry);

}  // namespace gmsim::check
