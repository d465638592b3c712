// SPDX-License-Identifier: MIT
#include "syntax/ast_factories.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "syntax/parse_context.h"

namespace gmsim::syntax {
namespace {

using support::DiagnosticKind;

/// The whole number at a place, if it fits; else 0, with an error.
int read_int(ParseContext& context, Span number) {
  const std::string_view text = context.text(number);
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size()) return value;
  context.report({.kind = DiagnosticKind::BadNumber,
                  .message = fmt::format("`{}` is too large here", shortened(text)),
                  .place = number});
  return 0;
}

/// What a string literal stands for; its escapes have been checked by the scanner.
std::string unescape(std::string_view literal) {
  std::string text;
  for (std::size_t i = 1; i + 1 < literal.size(); ++i) {
    if (literal[i] == '\\' && i + 2 < literal.size()) ++i;
    text += literal[i];
  }
  return text;
}

template <class Node>
Item finish_item(ParseContext& context, Span span, Node node) {
  return Item{span, context.doc_above(span), std::move(node)};
}

void report_repeated(ParseContext& context, Span span, std::string_view clause) {
  context.report({.kind = DiagnosticKind::Syntax,
                  .message = fmt::format("{} is given twice", clause),
                  .place = span});
}

}  // namespace

// ---- items --------------------------------------------------------------------------------------

Item make_import(ParseContext& context, Span span, Span path_span) {
  return finish_item(context, span, ImportItem{unescape(context.text(path_span)), path_span});
}

Item make_item(ParseContext& context, Span span, DimensionStatement dimension) {
  return finish_item(context, span, dimension);
}

Item make_orbit_item(ParseContext& context, Span span, Name name, OrbitExpr orbit) {
  return finish_item(context, span, OrbitItem{std::move(name), std::move(orbit)});
}

Item make_embedding(ParseContext& context, Span span, Name name, TypeExpr type, OrbitExpr orbit,
                    Clauses clauses, ExprPtr default_value) {
  return finish_item(
      context, span,
      EmbeddingItem{std::move(name), std::move(type), std::move(orbit), clauses.optional,
                    std::move(clauses.kind), std::move(clauses.merge), std::move(default_value)});
}

Item make_derived(ParseContext& context, Span span, Name name, TypeExpr type, OrbitExpr orbit,
                  Name dart, ExprPtr value) {
  return finish_item(context, span,
                     DerivedItem{std::move(name), std::move(type), std::move(orbit),
                                 std::move(dart), std::move(value)});
}

Item make_function(ParseContext& context, Span span, Name name, std::vector<Name> parameters,
                   ExprPtr value) {
  return finish_item(context, span,
                     FunctionItem{std::move(name), std::move(parameters), std::move(value)});
}

Item make_pattern(ParseContext& context, Span span, Name name, std::vector<Name> parameters,
                  PatternBlock block) {
  return finish_item(context, span,
                     PatternItem{std::move(name), std::move(parameters), std::move(block)});
}

Item make_family(ParseContext& context, Span span, Name name, std::vector<Name> members) {
  return finish_item(context, span, FamilyItem{std::move(name), std::move(members)});
}

Item make_rule(ParseContext& context, Span span, ItemHead head, std::vector<Statement> body) {
  return finish_item(context, span,
                     RuleItem{std::move(head.name), std::move(head.hooks), std::move(body)});
}

Item make_interaction(ParseContext& context, Span span, ItemHead head,
                      std::vector<Statement> body) {
  return finish_item(context, span,
                     InteractionItem{head.external, std::move(head.name), std::move(head.orbit),
                                     std::move(head.dart), std::move(body)});
}

Item make_criterion(ParseContext& context, Span span, ItemHead head, std::vector<Statement> body) {
  return finish_item(context, span,
                     CriterionItem{std::move(head.name), std::move(head.interaction),
                                   std::move(head.orbit), std::move(head.dart), std::move(body)});
}

Item make_operation(ParseContext& context, Span span, ItemHead head, std::vector<Statement> body) {
  return finish_item(context, span,
                     OperationItem{std::move(head.name), std::move(head.orbit),
                                   std::move(head.dart), std::move(body)});
}

KindClause make_intensive(Span span) {
  return {KindClause::Kind::Intensive, nullptr, span};
}

KindClause make_extensive(Span span, ExprPtr split) {
  return {KindClause::Kind::Extensive, std::move(split), span};
}

Clauses add_clause(ParseContext& context, Clauses clauses, KindClause kind) {
  if (clauses.kind.kind != KindClause::Kind::None)
    report_repeated(context, kind.span, "`intensive` or `extensive`");
  clauses.kind = std::move(kind);
  return clauses;
}

Clauses add_clause(ParseContext& context, Clauses clauses, MergeClause merge, Span span) {
  if (clauses.merge) report_repeated(context, span, "`merge`");
  clauses.merge = std::move(merge);
  return clauses;
}

Clauses add_optional(ParseContext& context, Clauses clauses, Span span) {
  if (clauses.optional) report_repeated(context, span, "`optional`");
  clauses.optional = true;
  return clauses;
}

// ---- statements ---------------------------------------------------------------------------------

Statement make_side(Span span, SideKind side, PatternBlock block) {
  return {span, SideStatement{side, std::move(block)}};
}

namespace {

template <class Node>
Statement match_one(Span span, Span pattern_span, Node node) {
  PatternBlock block{{}, pattern_span};
  block.statements.push_back({pattern_span, std::move(node)});
  return make_side(span, SideKind::Match, std::move(block));
}

}  // namespace

Statement make_match(Span span, Span pattern_span, Chain chain) {
  return match_one(span, pattern_span, std::move(chain));
}

Statement make_match(Span span, Span pattern_span, PatternUse use) {
  return match_one(span, pattern_span, std::move(use));
}

Statement make_param(Span span, Name name, TypeExpr type, Clauses clauses, ExprPtr default_value) {
  return {span, ParamStatement{std::move(name), std::move(type), std::move(clauses.kind),
                               std::move(clauses.merge), std::move(default_value)}};
}

Statement make_let(Span span, Name name, ExprPtr value) {
  return {span, LetStatement{std::move(name), std::nullopt, std::move(value)}};
}

Statement make_macro(Span span, Name name, std::vector<Name> parameters, ExprPtr value) {
  return {span, LetStatement{std::move(name), std::move(parameters), std::move(value)}};
}

Statement make_force(Span span, std::vector<Name> targets, OrbitExpr orbit, ExprPtr value) {
  return {span, ForceStatement{std::move(targets), nullptr, std::move(orbit), std::move(value)}};
}

Statement make_force(Span span, Name target, ExprPtr collection, OrbitExpr orbit, ExprPtr value) {
  return {span, ForceStatement{list_of(std::move(target)), std::move(collection), std::move(orbit),
                               std::move(value)}};
}

DimensionStatement make_dimension_statement(ParseContext& context, Span span, Span number) {
  const int dimension = read_int(context, number);
  if (dimension < 1 || dimension > 3)
    context.report({.kind = DiagnosticKind::Dimension,
                    .message = "the dimension of a map is 1, 2 or 3",
                    .place = number});
  return {dimension, span};
}

// ---- patterns and orbits ------------------------------------------------------------------------

Chain begin_chain(NodeMention node) {
  return {list_of(std::move(node)), {}};
}

Chain extend_chain(Chain chain, Link link, NodeMention node) {
  chain.links.push_back(std::move(link));
  chain.nodes.push_back(std::move(node));
  return chain;
}

std::vector<LinkDimension> add_step(ParseContext& context, std::vector<LinkDimension> path,
                                    Span number) {
  const std::string_view text = context.text(number);
  if (text.find_first_not_of("0123456789.") != std::string_view::npos) {
    context.report({.kind = DiagnosticKind::BadNumber,
                    .message = fmt::format("`{}` is no path of links", shortened(text)),
                    .place = number});
    return path;
  }
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('.', begin), text.size());
    path.push_back(
        make_dimension(context, {number.file, number.begin + static_cast<std::uint32_t>(begin),
                                 number.begin + static_cast<std::uint32_t>(end)}));
    begin = end + 1;
  }
  return path;
}

std::vector<LinkDimension> lower_top(ParseContext& context, std::vector<LinkDimension> path,
                                     Span number) {
  const LinkDimension top = path.back();
  path.pop_back();
  const std::size_t first = path.size();
  path = add_step(context, std::move(path), number);
  if (first == path.size()) return append(std::move(path), top);  // reported
  path[first].from_top = true;
  path[first].span = join(top.span, path[first].span);
  return path;
}

LinkDimension make_dimension(ParseContext& context, Span number) {
  return {false, read_int(context, number), number};
}

LinkDimension make_dimension_below_top(ParseContext& context, Span span, Span number) {
  return {true, read_int(context, number), span};
}

OrbitExpr make_named_orbit(Name name) {
  const Span span = name.span;
  return {std::move(name), {}, span};
}

OrbitEntry make_blank(Span span) {
  return {OrbitEntry::Kind::Blank, {}, {}, span};
}

OrbitEntry make_single(Span span, LinkDimension dimension) {
  return {OrbitEntry::Kind::Single, dimension, {}, span};
}

OrbitEntry make_range(Span span, LinkDimension first, LinkDimension last) {
  return {OrbitEntry::Kind::Range, first, last, span};
}

// ---- types and units ----------------------------------------------------------------------------

TypeExpr make_type(Name name) {
  const Span span = name.span;
  return {std::move(name), {}, std::nullopt, span};
}

TypeExpr add_extent(ParseContext& context, TypeExpr type, Span number) {
  const bool after_unit = !type.extents.empty() && type.extents.back() < 2;
  const int extent = read_int(context, number);
  if (extent == 0 || after_unit)
    context.report({.kind = DiagnosticKind::BadNumber,
                    .message = "the length of an array is at least 2",
                    .place = number,
                    .help = "`[1]`, the unit of plain numbers, stands last"});
  type.extents.push_back(static_cast<std::uint32_t>(extent));
  type.span = join(type.span, number);
  return type;
}

TypeExpr finish_type(ParseContext& context, Span span, TypeExpr type,
                     std::optional<UnitExpr> unit) {
  const Span extents_span = type.span;
  type.span = span;
  type.unit = std::move(unit);
  if (type.extents.empty() || type.extents.back() != 1) return type;
  type.extents.pop_back();
  if (type.unit)
    context.report({.kind = DiagnosticKind::BadNumber,
                    .message = "the length of an array is at least 2",
                    .place = extents_span});
  type.unit = UnitExpr{{}, span};
  return type;
}

UnitExpr make_plain_unit(ParseContext& context, Span number) {
  if (const std::string_view text = context.text(number); text != "1")
    context.report({.kind = DiagnosticKind::Syntax,
                    .message = fmt::format("`{}` is no unit; plain numbers have the unit `[1]`",
                                           shortened(text)),
                    .place = number});
  return {{}, number};
}

UnitExpr divide_unit(Span span, std::vector<UnitFactor> above, std::vector<UnitFactor> below) {
  for (UnitFactor& factor : below) {
    factor.numerator = -factor.numerator;
    above.push_back(std::move(factor));
  }
  return {std::move(above), span};
}

UnitExpr invert_unit(ParseContext& context, Span span, Span one, std::vector<UnitFactor> below) {
  make_plain_unit(context, one);
  return divide_unit(span, {}, std::move(below));
}

UnitExpr reject_unit(ParseContext& context, Span span, std::vector<UnitFactor> above,
                     std::vector<UnitFactor> below, std::vector<UnitFactor> tail) {
  context.report({.kind = DiagnosticKind::AmbiguousUnit,
                  .message = "this unit can be read in two ways",
                  .place = span,
                  .help = "put what is divided by in parentheses, as in `[N/(m s)]`"});
  return divide_unit(span, std::move(above), append_all(std::move(below), std::move(tail)));
}

UnitFactor raise_unit(ParseContext& context, Name name, int sign, Span numerator,
                      std::optional<Span> denominator) {
  const int above = read_int(context, numerator);
  const int below = denominator ? read_int(context, *denominator) : 1;
  if (below == 0)
    context.report({.kind = DiagnosticKind::BadNumber,
                    .message = "an exponent divided by zero",
                    .place = denominator});
  return {std::move(name), sign * above, below};
}

}  // namespace gmsim::syntax
