// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "check/checked_rule.h"
#include "types/expr.h"

/// Making, folding and rewriting checked expressions.
namespace gmsim::check {

using types::ExprKind;
using types::ValueKind;
using types::ValueType;

[[nodiscard]] ExprPtr make_literal(types::Value value, const types::MaybeUnit& unit, Span span);
[[nodiscard]] ExprPtr make_local(Slot slot, const ValueType& type, const types::MaybeUnit& unit,
                                 Span span);
/// What stands for an expression that was reported; agrees with everything.
[[nodiscard]] ExprPtr make_error(Span span);
/// An operation whose payload is complete; folded to a literal when all its arguments are literals
/// and the result is exact to define (arithmetic, comparisons, logic, tuples).
[[nodiscard]] ExprPtr make_expr(types::Expr expr);
/// Let(slot = bound, body)
[[nodiscard]] ExprPtr make_let(Slot slot, ExprPtr bound, ExprPtr body);
/// The same expression with another place or unit.
[[nodiscard]] ExprPtr with_span(const ExprPtr& expr, Span span);
[[nodiscard]] ExprPtr with_unit(const ExprPtr& expr, const types::MaybeUnit& unit);

[[nodiscard]] bool is_error(const ExprPtr& expr);
[[nodiscard]] bool is_literal(const ExprPtr& expr);
[[nodiscard]] bool has_kind(const ExprPtr& expr, ValueKind kind);
/// A whole number known when the file is read.
[[nodiscard]] std::optional<std::int64_t> constant_int(const ExprPtr& expr);
[[nodiscard]] std::optional<bool> constant_bool(const ExprPtr& expr);
/// The value of an expression made of literals only, of its own type.
[[nodiscard]] std::optional<types::Value> constant_value(const types::Expr& expr);

/// Converts int to real and the literal 0 to the zero of any storable type; null when the types do
/// not agree. Error agrees with every type.
[[nodiscard]] ExprPtr convert(const ExprPtr& expr, const ValueType& type);
/// The literal 0 becomes an int where nothing asks for another type.
[[nodiscard]] ExprPtr settle(const ExprPtr& expr);

/// A node or variable, or a walk from one: cheap and without effects, so it may stand wherever its
/// name does.
[[nodiscard]] bool is_walk(const types::Expr& expr);

/// Rebuilds an expression, children first; `change` returns null to keep a node. Shared subtrees
/// stay shared.
[[nodiscard]] ExprPtr transform(const ExprPtr& expr,
                                const std::function<ExprPtr(const types::Expr&)>& change);
/// Calls `visit` for each distinct node, parents first.
void for_each_node(const ExprPtr& expr, const std::function<void(const types::Expr&)>& visit);
/// Slots that an expression reads, whether bound inside of it or not.
[[nodiscard]] std::set<Slot> slots_read(const ExprPtr& expr);
/// Wraps an expression in those `let` steps that it reads, so that it stands by itself.
[[nodiscard]] ExprPtr close_over(const ExprPtr& expr, const std::vector<Step>& steps);

}  // namespace gmsim::check
