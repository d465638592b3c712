// SPDX-License-Identifier: MIT
// Folds and the collections they go over.
#include <map>
#include <utility>

#include "check/check_expr.h"
#include "support/suggest.h"

namespace gmsim::check {
using support::DiagnosticKind;
using types::Expr;
using types::FoldKind;
using types::Unit;
namespace {

const std::map<std::string, FoldKind>& fold_words() {
  static const std::map<std::string, FoldKind> words = {
      {"sum", FoldKind::Sum},     {"mean", FoldKind::Mean},     {"min", FoldKind::Min},
      {"max", FoldKind::Max},     {"count", FoldKind::Count},   {"any", FoldKind::Any},
      {"all", FoldKind::All},     {"argmax", FoldKind::ArgMax}, {"argmin", FoldKind::ArgMin}};
  return words;
}

bool can_add(const ValueType& type) {
  if (type.is_array()) return false;
  switch (type.kind) {
    case ValueKind::Int:
    case ValueKind::Real:
    case ValueKind::Vec2:
    case ValueKind::Vec3:
    case ValueKind::Mat2:
    case ValueKind::Mat3:
    case ValueKind::Sym3: return true;
    default: return false;
  }
}

bool is_ordered(const ExprPtr& e) {
  return has_kind(e, ValueKind::Int) || has_kind(e, ValueKind::Real);
}

}  // namespace

ExprPtr ExprChecker::check_collection(const syntax::ExprPtr& expr) {
  const ExprPtr collection = check(expr);
  if (is_error(collection) || has_kind(collection, ValueKind::Darts) ||
      has_kind(collection, ValueKind::Range) || has_kind(collection, ValueKind::Forces))
    return collection;
  return type_mismatch(collection->span, "`in` needs a collection, this is " +
                                             found_text(collection),
                       "collections are orbits as in `vertex(a)`, `vertex(a) / corner`, "
                       "`polygon(a)` and ranges `0..8`");
}

ExprPtr ExprChecker::declare_variable(const syntax::Name& name, const ExprPtr& collection) {
  ValueType type{ValueKind::Error};
  types::MaybeUnit unit;
  if (has_kind(collection, ValueKind::Darts)) type = {ValueKind::Dart};
  if (has_kind(collection, ValueKind::Range)) type = {ValueKind::Int}, unit = Unit{};
  if (has_kind(collection, ValueKind::Forces)) type = {ValueKind::Vec3}, unit = collection->unit;
  Binding binding{.name = name.text, .kind = Binding::Kind::FoldVariable,
                  .value = make_local(context_.new_slot(name.text), type, unit, name.span),
                  .span = name.span};
  if (collection->kind == ExprKind::Range) {
    const auto lo = constant_int(collection->args[0]), hi = constant_int(collection->args[1]);
    if (lo && hi) binding.range = {*lo, *hi};
  }
  ExprPtr variable = binding.value;
  context_.declare(std::move(binding));
  return variable;
}

ExprPtr ExprChecker::range(const syntax::RangeExpr& expr, Span span) {
  const Wanted end{.type = {ValueKind::Int}, .what = "an end of a range"};
  const ExprPtr lo = check_as(expr.lo, end), hi = check_as(expr.hi, end);
  if (is_error(lo) || is_error(hi)) return make_error(span);
  Expr range{.kind = ExprKind::Range, .type = {ValueKind::Range}, .unit = {}, .span = span};
  range.args = {lo, hi};
  return std::make_shared<const Expr>(std::move(range));
}

ExprPtr ExprChecker::all(const syntax::AllExpr& expr, Span span) {
  const auto orbit = resolve_orbit(context_, expr.orbit);
  if (!orbit) return make_error(span);
  if (!context_.allow_all) {
    context_.report({.kind = DiagnosticKind::BadItem,
                     .message = "`all` goes over the whole map; it stands in operations and in the "
                                "expressions of a scene",
                     .place = span});
    return make_error(span);
  }
  Expr all{.kind = ExprKind::AllOrbits, .type = {ValueKind::Darts}, .unit = {}, .span = span};
  all.orbit = *orbit;
  return make_expr(std::move(all));
}

ExprPtr ExprChecker::fold(const syntax::FoldExpr& expr, Span span) {
  const auto word = fold_words().find(expr.fold.text);
  if (word == fold_words().end()) {
    std::vector<std::string> names;
    for (const auto& [name, kind] : fold_words()) names.push_back(name);
    context_.report({.kind = DiagnosticKind::UnknownFunction,
                     .message = "`" + expr.fold.text + "` does not go over a collection",
                     .place = expr.fold.span,
                     .help = support::did_you_mean(expr.fold.text, names)});
    return make_error(span);
  }
  const ExprPtr collection = check_collection(expr.collection);
  const std::size_t outer = context_.scope.size();
  const ExprPtr variable = declare_variable(expr.variable, collection);
  ExprPtr folded = fold_body(word->second, expr, span);
  context_.scope.shrink(outer);
  if (is_error(folded) || is_error(collection)) return make_error(span);
  Expr result = *folded;
  result.args.insert(result.args.begin(), collection);
  result.slot = variable->slot;
  return std::make_shared<const Expr>(std::move(result));
}

/// The fold without its collection: kind, type, unit and bodies.
ExprPtr ExprChecker::fold_body(FoldKind kind, const syntax::FoldExpr& expr, Span span) {
  const std::string word = "`" + expr.fold.text + "`";
  Expr fold{.kind = ExprKind::Fold, .type = {}, .unit = {}, .span = span};
  fold.fold = kind;
  const bool arg = kind == FoldKind::ArgMax || kind == FoldKind::ArgMin;
  const bool logic = kind == FoldKind::Any || kind == FoldKind::All;
  if ((!expr.body && kind != FoldKind::Count) || (arg != (expr.result != nullptr))) {
    context_.report({.kind = DiagnosticKind::ArgumentCount,
                     .message = arg ? word + " needs a key and a result"
                                    : word + (expr.result ? " has one body" : " needs a body"),
                     .place = expr.fold.span,
                     .help = arg ? "write " + expr.fold.text + "(x in … : key : result)"
                                 : "write " + expr.fold.text + "(x in … : value)"});
    return make_error(span);
  }
  if (logic || kind == FoldKind::Count) {
    fold.type = {logic ? ValueKind::Bool : ValueKind::Int};
    if (!logic) fold.unit = Unit{};
    if (expr.body) fold.args = {check_condition(expr.body, "the body of " + word)};
    if (expr.body && is_error(fold.args[0])) return fold.args[0];
    return std::make_shared<const Expr>(std::move(fold));
  }
  ExprPtr body = settle(check(expr.body));
  if (is_error(body)) return body;
  const bool sums = kind == FoldKind::Sum || kind == FoldKind::Mean;
  if (sums ? !can_add(body->type) : !is_ordered(body))
    return type_mismatch(body->span, word + " cannot take " + found_text(body));
  if (kind == FoldKind::Mean && has_kind(body, ValueKind::Int))
    body = convert(body, {ValueKind::Real});
  fold.type = body->type;
  fold.unit = body->unit;
  fold.args = {body};
  if (arg) {
    const ExprPtr result = settle(check(expr.result));
    if (is_error(result)) return result;
    if (!is_storable(result->type) && !has_kind(result, ValueKind::Dart))
      return type_mismatch(result->span, word + " cannot give " + found_text(result));
    fold.type = result->type;
    fold.unit = result->unit;
    fold.args.push_back(result);
  }
  return std::make_shared<const Expr>(std::move(fold));
}

}  // namespace gmsim::check
