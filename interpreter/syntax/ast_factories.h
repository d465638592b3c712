// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "syntax/ast.h"
#include "syntax/boxed.h"

/// What the actions of grammar/rule_parser.yy call: one function for each shape of node. Those
/// that take the ParseContext can report errors, read what is written at a place, or find the
/// `///` lines above an item.
namespace gmsim::syntax {

class ParseContext;

/// Items with a body of statements.
enum class ItemKind { Rule, Interaction, Criterion, Operation };

/// What stands before the body of an item.
struct ItemHead {
  Name name;
  std::vector<Name> hooks = {};
  OrbitExpr orbit = {};
  Name dart = {};
  std::optional<Name> interaction = std::nullopt;
  bool external = false;
};

/// The clauses after the orbit or type of a declaration.
struct Clauses {
  bool optional = false;
  KindClause kind;
  std::optional<MergeClause> merge;
};

template <class T>
std::vector<T> list_of(T element) {
  std::vector<T> list;
  list.push_back(std::move(element));
  return list;
}
template <class T>
std::vector<T> list_of(Boxed<T> element) {
  return list_of<T>(T(std::move(element)));
}
template <class T>
std::vector<T> append(std::vector<T> list, T element) {
  list.push_back(std::move(element));
  return list;
}
template <class T>
std::vector<T> append(std::vector<T> list, Boxed<T> element) {
  list.push_back(std::move(element));
  return list;
}
template <class T>
std::vector<T> append_all(std::vector<T> list, std::vector<T> more) {
  for (T& element : more) list.push_back(std::move(element));
  return list;
}

// ---- items --------------------------------------------------------------------------------------

Item make_import(ParseContext& context, Span span, Span path_span);
Item make_item(ParseContext& context, Span span, DimensionStatement dimension);
Item make_orbit_item(ParseContext& context, Span span, Name name, OrbitExpr orbit);
Item make_embedding(ParseContext& context, Span span, Name name, TypeExpr type, OrbitExpr orbit,
                    Clauses clauses, ExprPtr default_value);
Item make_derived(ParseContext& context, Span span, Name name, TypeExpr type, OrbitExpr orbit,
                  Name dart, ExprPtr value);
Item make_function(ParseContext& context, Span span, Name name, std::vector<Name> parameters,
                   ExprPtr value);
Item make_pattern(ParseContext& context, Span span, Name name, std::vector<Name> parameters,
                  PatternBlock block);
Item make_family(ParseContext& context, Span span, Name name, std::vector<Name> members);
Item make_rule(ParseContext& context, Span span, ItemHead head, std::vector<Statement> body);
Item make_interaction(ParseContext& context, Span span, ItemHead head, std::vector<Statement> body);
Item make_criterion(ParseContext& context, Span span, ItemHead head, std::vector<Statement> body);
Item make_operation(ParseContext& context, Span span, ItemHead head, std::vector<Statement> body);

KindClause make_intensive(Span span);
KindClause make_extensive(Span span, ExprPtr split);
/// Each clause may be given once.
Clauses add_clause(ParseContext& context, Clauses clauses, KindClause kind);
Clauses add_clause(ParseContext& context, Clauses clauses, MergeClause merge, Span span);
Clauses add_optional(ParseContext& context, Clauses clauses, Span span);

// ---- statements ---------------------------------------------------------------------------------

template <class Node>
Statement make_statement(Span span, Node node) {
  return Statement{span, std::move(node)};
}
inline Statement make_statement(Span, Statement statement) {
  return statement;
}
Statement make_side(Span span, SideKind side, PatternBlock block);
/// `match` with one chain or one pattern, without braces.
Statement make_match(Span span, Span pattern_span, Chain chain);
Statement make_match(Span span, Span pattern_span, PatternUse use);
Statement make_param(Span span, Name name, TypeExpr type, Clauses clauses, ExprPtr default_value);
Statement make_let(Span span, Name name, ExprPtr value);
Statement make_macro(Span span, Name name, std::vector<Name> parameters, ExprPtr value);
Statement make_force(Span span, std::vector<Name> targets, OrbitExpr orbit, ExprPtr value);
Statement make_force(Span span, Name target, ExprPtr collection, OrbitExpr orbit, ExprPtr value);
/// A map has dimension 1, 2 or 3.
DimensionStatement make_dimension_statement(ParseContext& context, Span span, Span number);

// ---- patterns and orbits ------------------------------------------------------------------------

Chain begin_chain(NodeMention node);
Chain extend_chain(Chain chain, Link link, NodeMention node);
/// Adds the dimensions of a piece of a path: `0`, or `0.1`, which reads as a number.
std::vector<LinkDimension> add_step(ParseContext& context, std::vector<LinkDimension> path,
                                    Span number);
/// Turns the `n` at the end of a path into `n-1`, or, since a number can hold a dot, into `n-1.0`.
std::vector<LinkDimension> lower_top(ParseContext& context, std::vector<LinkDimension> path,
                                     Span number);
LinkDimension make_dimension(ParseContext& context, Span number);
LinkDimension make_dimension_below_top(ParseContext& context, Span span, Span number);
OrbitExpr make_named_orbit(Name name);
OrbitEntry make_blank(Span span);
OrbitEntry make_single(Span span, LinkDimension dimension);
OrbitEntry make_range(Span span, LinkDimension first, LinkDimension last);

// ---- types and units ----------------------------------------------------------------------------

TypeExpr make_type(Name name);
TypeExpr add_extent(ParseContext& context, TypeExpr type, Span number);
/// Array lengths are at least 2; `[1]` at the end is the unit of plain numbers.
TypeExpr finish_type(ParseContext& context, Span span, TypeExpr type,
                     std::optional<UnitExpr> unit = std::nullopt);
/// `[1]`.
UnitExpr make_plain_unit(ParseContext& context, Span number);
UnitExpr divide_unit(Span span, std::vector<UnitFactor> above, std::vector<UnitFactor> below);
/// `[1/s]`.
UnitExpr invert_unit(ParseContext& context, Span span, Span one, std::vector<UnitFactor> below);
/// `[N/m s]`: reported, and read as `[N/(m s)]`.
UnitExpr reject_unit(ParseContext& context, Span span, std::vector<UnitFactor> above,
                     std::vector<UnitFactor> below, std::vector<UnitFactor> tail);
inline UnitExpr reject_unit(ParseContext& context, Span span, std::vector<UnitFactor> above,
                            UnitFactor below, std::vector<UnitFactor> tail) {
  return reject_unit(context, span, std::move(above), list_of(std::move(below)), std::move(tail));
}
UnitFactor raise_unit(ParseContext& context, Name name, int sign, Span numerator,
                      std::optional<Span> denominator = std::nullopt);

// ---- expressions --------------------------------------------------------------------------------

ExprPtr make_number(ParseContext& context, Span span, bool is_integer, Span number,
                    std::optional<UnitExpr> unit);
inline ExprPtr make_number(ParseContext& context, Span span, bool is_integer) {
  return make_number(context, span, is_integer, span, std::nullopt);
}
ExprPtr make_bool(ParseContext& context, Span span, bool value);
ExprPtr make_top(ParseContext& context, Span span);
ExprPtr make_name_expr(ParseContext& context, Name name);
ExprPtr make_member(ParseContext& context, Span span, ExprPtr object, Name member);
ExprPtr make_walk(ParseContext& context, Span span, ExprPtr object, LinkDimension dimension);
ExprPtr make_index(ParseContext& context, Span span, ExprPtr object, ExprPtr index);
ExprPtr make_call(ParseContext& context, Span span, Name callee, std::vector<ExprPtr> arguments);
ExprPtr make_orbit_literal(ParseContext& context, Span span, OrbitExpr orbit, ExprPtr argument);
ExprPtr make_all(ParseContext& context, Span span, OrbitExpr orbit);
ExprPtr make_range_expr(ParseContext& context, Span span, ExprPtr lo, ExprPtr hi);
ExprPtr make_fold(ParseContext& context, Span span, Name fold, Name variable, ExprPtr collection,
                  ExprPtr body = nullptr, ExprPtr result = nullptr);
ExprPtr make_unary(ParseContext& context, Span span, UnaryOp op, ExprPtr operand);
ExprPtr make_binary(ParseContext& context, Span span, BinaryOp op, Span op_span, ExprPtr left,
                    ExprPtr right);
ExprPtr make_if_expr(ParseContext& context, Span span, ExprPtr condition, ExprPtr then_value,
                     ExprPtr else_value);
ExprPtr make_tuple(ParseContext& context, Span span, ExprPtr first, std::vector<ExprPtr> rest);
ExprPtr add_unit(Span span, ExprPtr tuple, UnitExpr unit);
ExprPtr parenthesise(Span span, ExprPtr expression);

}  // namespace gmsim::syntax
