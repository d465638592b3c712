// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <type_traits>

#include "syntax/ast_factories.h"
#include "syntax/parse_context.h"

namespace gmsim::syntax {
namespace {

using support::DiagnosticKind;

std::uint16_t height(const ExprPtr& expr) {
  return expr ? expr->height : std::uint16_t{0};
}
std::uint16_t height(const std::vector<ExprPtr>& list) {
  std::uint16_t highest = 0;
  for (const ExprPtr& expr : list) highest = std::max(highest, height(expr));
  return highest;
}
template <class... Parts>
std::uint16_t highest(const Parts&... parts) {
  return std::max({height(parts)...});
}

/// A node above parts of the given height. Where the tree gets too high it is cut: the node is
/// replaced by a constant, and an error reported.
template <class Node>
ExprPtr make_expr(ParseContext& context, Span span, Node node, std::uint16_t part_height = 0) {
  auto expr = std::make_unique<Expr>();
  expr->span = span;
  if (part_height < kHighestTree) {
    expr->node = std::move(node);
    expr->height = static_cast<std::uint16_t>(part_height + 1);
  } else {
    context.report_too_high(span);
    expr->node = BoolExpr{};
  }
  return expr;
}

}  // namespace

ExprPtr make_number(ParseContext& context, Span span, bool is_integer, Span number,
                    std::optional<UnitExpr> unit) {
  NumberExpr node{std::string(context.text(number)), 0, is_integer, std::move(unit)};
  const char* begin = node.text.data();
  const auto [end, error] = std::from_chars(begin, begin + node.text.size(), node.value);
  if (error == std::errc::result_out_of_range)
    context.report(
        {.kind = DiagnosticKind::BadNumber,
         .message = fmt::format("`{}` is outside of what a number can hold", shortened(node.text)),
         .place = number});
  return make_expr(context, span, std::move(node));
}

ExprPtr make_bool(ParseContext& context, Span span, bool value) {
  return make_expr(context, span, BoolExpr{value});
}

ExprPtr make_top(ParseContext& context, Span span) {
  return make_expr(context, span, DimensionExpr{});
}

ExprPtr make_name_expr(ParseContext& context, Name name) {
  const Span span = name.span;
  return make_expr(context, span, NameExpr{std::move(name)});
}

ExprPtr make_member(ParseContext& context, Span span, ExprPtr object, Name member) {
  const auto parts = highest(object);
  return make_expr(context, span, MemberExpr{std::move(object), std::move(member)}, parts);
}

ExprPtr make_walk(ParseContext& context, Span span, ExprPtr object, LinkDimension dimension) {
  const auto parts = highest(object);
  return make_expr(context, span, WalkExpr{std::move(object), dimension}, parts);
}

ExprPtr make_index(ParseContext& context, Span span, ExprPtr object, ExprPtr index) {
  const auto parts = highest(object, index);
  return make_expr(context, span, IndexExpr{std::move(object), std::move(index)}, parts);
}

ExprPtr make_call(ParseContext& context, Span span, Name callee, std::vector<ExprPtr> arguments) {
  const auto parts = highest(arguments);
  return make_expr(context, span, CallExpr{std::move(callee), std::move(arguments)}, parts);
}

ExprPtr make_orbit_literal(ParseContext& context, Span span, OrbitExpr orbit, ExprPtr argument) {
  const auto parts = highest(argument);
  return make_expr(context, span, OrbitLiteralExpr{std::move(orbit), std::move(argument)}, parts);
}

ExprPtr make_all(ParseContext& context, Span span, OrbitExpr orbit) {
  return make_expr(context, span, AllExpr{std::move(orbit)});
}

ExprPtr make_range_expr(ParseContext& context, Span span, ExprPtr lo, ExprPtr hi) {
  const auto parts = highest(lo, hi);
  return make_expr(context, span, RangeExpr{std::move(lo), std::move(hi)}, parts);
}

ExprPtr make_fold(ParseContext& context, Span span, Name fold, Name variable, ExprPtr collection,
                  ExprPtr body, ExprPtr result) {
  const auto parts = highest(collection, body, result);
  return make_expr(context, span,
                   FoldExpr{std::move(fold), std::move(variable), std::move(collection),
                            std::move(body), std::move(result)},
                   parts);
}

ExprPtr make_unary(ParseContext& context, Span span, UnaryOp op, ExprPtr operand) {
  const auto parts = highest(operand);
  return make_expr(context, span, UnaryExpr{op, std::move(operand)}, parts);
}

ExprPtr make_binary(ParseContext& context, Span span, BinaryOp op, Span op_span, ExprPtr left,
                    ExprPtr right) {
  const auto parts = highest(left, right);
  return make_expr(context, span, BinaryExpr{op, op_span, std::move(left), std::move(right)},
                   parts);
}

ExprPtr make_if_expr(ParseContext& context, Span span, ExprPtr condition, ExprPtr then_value,
                     ExprPtr else_value) {
  const auto parts = highest(condition, then_value, else_value);
  return make_expr(context, span,
                   IfExpr{std::move(condition), std::move(then_value), std::move(else_value)},
                   parts);
}

ExprPtr make_tuple(ParseContext& context, Span span, ExprPtr first, std::vector<ExprPtr> rest) {
  TupleExpr tuple;
  tuple.elements = append_all(list_of(std::move(first)), std::move(rest));
  const auto parts = highest(tuple.elements);
  return make_expr(context, span, std::move(tuple), parts);
}

ExprPtr add_unit(Span span, ExprPtr tuple, UnitExpr unit) {
  if (auto* node = std::get_if<TupleExpr>(&tuple->node)) node->unit = std::move(unit);
  tuple->span = span;
  return tuple;
}

ExprPtr parenthesise(Span span, ExprPtr expression) {
  expression->span = span;
  expression->parenthesised = true;
  return expression;
}

}  // namespace gmsim::syntax
