// SPDX-License-Identifier: MIT
// Calls that read their arguments in a way of their own: has, free, random, forces, grad, …
#include <map>
#include <utility>

#include "check/check_expr.h"
#include "check/differentiable.h"

namespace gmsim::check {
using support::DiagnosticKind;
using types::Expr;
using types::Unit;
namespace {

const Unit& newtons() {
  static const Unit unit = types::named_unit("N")->unit;
  return unit;
}

}  // namespace

std::optional<ExprPtr> ExprChecker::form(const syntax::CallExpr& expr, Span span) {
  struct Form {
    std::size_t fewest;
    std::size_t most;
    ExprPtr (ExprChecker::*check)(const syntax::CallExpr&, Span);
  };
  static const std::map<std::string, Form> forms = {
      {"has", {1, 1, &ExprChecker::has_form}},
      {"free", {2, 2, &ExprChecker::free_form}},
      {"random", {2, 2, &ExprChecker::random_form}},
      {"forces", {1, 1, &ExprChecker::forces_form}},
      {"force_on", {1, 2, &ExprChecker::force_on_form}},
      {"grad", {2, 2, &ExprChecker::grad_form}},
      {"frozen", {1, 1, &ExprChecker::frozen_form}},
      {"polygon", {1, 1, &ExprChecker::polygon_form}}};
  const auto found = forms.find(expr.callee.text);
  if (found == forms.end()) return std::nullopt;
  const std::size_t count = expr.arguments.size();
  if (count < found->second.fewest || count > found->second.most) {
    check_count(expr, count < found->second.fewest ? found->second.fewest : found->second.most);
    return make_error(span);
  }
  return (this->*found->second.check)(expr, span);
}

/// `has(a.x)`, `has(a.spring)`, `has(a.family)`.
ExprPtr ExprChecker::has_form(const syntax::CallExpr& expr, Span span) {
  const syntax::Expr* argument = expr.arguments[0].get();
  const auto* member = argument ? std::get_if<syntax::MemberExpr>(&argument->node) : nullptr;
  const auto* bare = argument ? std::get_if<syntax::NameExpr>(&argument->node) : nullptr;
  const bool is_bare = bare && context_.bare_dart && !context_.scope.find(bare->name.text);
  if (!member && !is_bare)
    return type_mismatch(argument ? argument->span : span,
                         "`has` asks for a value at a dart, as in `has(a.name)`");
  if (member && member->object)
    if (const auto owner = interaction_owner(*member->object)) {
      const auto embedding = find_member(*owner->second, member->member);
      if (!embedding || is_error(owner->first)) return make_error(span);
      return read(ExprKind::Has, owner->first, *embedding, span);
    }
  const syntax::Name& name = member ? member->member : bare->name;
  const ExprPtr dart = member ? check_dart(member->object, "`has`") : context_.bare_dart;
  const auto ref = find_value_ref(name);
  if (!ref || (is_error(dart) && !context_.dart_uses)) return make_error(span);
  if (const auto* id = std::get_if<EmbeddingId>(&*ref))
    return read(ExprKind::Has, dart, *id, span);
  const gmap::EmbeddingSchema& schema = context_.env.library->schema;
  if (std::holds_alternative<InteractionId>(*ref))
    return read(ExprKind::Has, dart, *schema.find(name.text), span);
  ExprPtr any;
  const auto& family =
      context_.env.library->families[static_cast<std::size_t>(std::get<FamilyIndex>(*ref))];
  for (const InteractionId id : family.members) {
    const std::string& interaction = context_.env.library->interactions[types::index(id)].name;
    const ExprPtr has = read(ExprKind::Has, dart, *schema.find(interaction), span);
    any = any ? make(ExprKind::Or, {ValueKind::Bool}, {}, span, {any, has}) : has;
  }
  return any ? any : make_error(span);
}

ExprPtr ExprChecker::free_form(const syntax::CallExpr& expr, Span span) {
  const ExprPtr dart = check_dart(expr.arguments[0], "`free`");
  const ExprPtr link = check(expr.arguments[1]);
  if (is_error(link) || (is_error(dart) && !context_.dart_uses)) return make_error(span);
  const auto dimension = constant_int(link);
  if (!dimension) {
    context_.report({.kind = DiagnosticKind::NotConstant,
                     .message = "a link dimension must be a constant",
                     .place = link->span});
    return make_error(span);
  }
  const syntax::LinkDimension written{false, static_cast<int>(*dimension), link->span};
  const auto resolved = resolve_link(context_, written, DiagnosticKind::Dimension);
  if (!resolved) return make_error(span);
  Expr free{.kind = ExprKind::Free, .type = {ValueKind::Bool}, .unit = {}, .span = span};
  free.args = {dart};
  free.number = *resolved;
  return make_expr(std::move(free));
}

/// `vertex(a)` as an argument that names an orbit and a dart.
ExprPtr ExprChecker::orbit_argument(const syntax::ExprPtr& expr, const std::string& what) {
  const ExprPtr orbit = check(expr);
  if (is_error(orbit) || orbit->kind == ExprKind::OrbitDarts) return orbit;
  return type_mismatch(orbit->span,
                       what + " takes an orbit, as in `vertex(a)`; this is " + found_text(orbit));
}

ExprPtr ExprChecker::random_form(const syntax::CallExpr& expr, Span span) {
  const ExprPtr seed =
      check_as(expr.arguments[0], {.type = {ValueKind::Int}, .what = "the seed of `random`"});
  const ExprPtr orbit = orbit_argument(expr.arguments[1], "`random`");
  if (is_error(seed) || is_error(orbit)) return make_error(span);
  Expr random{.kind = ExprKind::Random, .type = {ValueKind::Real}, .unit = Unit{}, .span = span};
  random.args = {seed, orbit->args[0]};
  random.orbit = orbit->orbit;
  return make_expr(std::move(random));
}

bool ExprChecker::forces_allowed(Span span) {
  if (context_.allow_forces) return true;
  context_.report({.kind = DiagnosticKind::RecursiveDefinition,
                   .message = "a force cannot be computed from forces",
                   .place = span});
  return false;
}

ExprPtr ExprChecker::forces_form(const syntax::CallExpr& expr, Span span) {
  const ExprPtr orbit = orbit_argument(expr.arguments[0], "`forces`");
  if (is_error(orbit) || !forces_allowed(span)) return make_error(span);
  Expr forces{.kind = ExprKind::Forces, .type = {ValueKind::Forces}, .unit = newtons(),
              .span = span};
  forces.args = orbit->args;
  forces.orbit = orbit->orbit;
  return make_expr(std::move(forces));
}

/// `force_on(O(a))`, `force_on(O(a), interaction)`; of a family the sum over its members.
ExprPtr ExprChecker::force_on_form(const syntax::CallExpr& expr, Span span) {
  const ExprPtr orbit = orbit_argument(expr.arguments[0], "`force_on`");
  if (is_error(orbit) || !forces_allowed(span)) return make_error(span);
  Expr force{.kind = ExprKind::ForceOn, .type = {ValueKind::Vec3}, .unit = newtons(),
             .span = span};
  force.args = orbit->args;
  force.orbit = orbit->orbit;
  if (expr.arguments.size() == 1) return make_expr(std::move(force));
  const syntax::Expr* argument = expr.arguments[1].get();
  const auto* name = argument ? std::get_if<syntax::NameExpr>(&argument->node) : nullptr;
  if (!name)
    return type_mismatch(argument ? argument->span : span,
                         "`force_on` takes the name of an interaction");
  const auto ref = find_value_ref(name->name);
  if (!ref) return make_error(span);
  if (std::holds_alternative<EmbeddingId>(*ref))
    return type_mismatch(argument->span, "`" + name->name.text + "` is no interaction");
  force.number = 1;
  if (const auto* id = std::get_if<InteractionId>(&*ref)) {
    force.interaction = *id;
    return make_expr(std::move(force));
  }
  ExprPtr sum;
  const auto& family =
      context_.env.library->families[static_cast<std::size_t>(std::get<FamilyIndex>(*ref))];
  for (const InteractionId id : family.members) {
    force.interaction = id;
    const ExprPtr one = make_expr(force);
    sum = sum ? make(ExprKind::Add, one->type, one->unit, span, {sum, one}) : one;
  }
  return sum ? sum : make_error(span);
}

ExprPtr ExprChecker::grad_form(const syntax::CallExpr& expr, Span span) {
  const ExprPtr value =
      check_as(expr.arguments[0], {.type = {ValueKind::Real}, .what = "what `grad` differentiates"});
  const ExprPtr variable = check(expr.arguments[1]);
  if (is_error(value) || is_error(variable)) return make_error(span);
  const bool differentiable =
      has_kind(variable, ValueKind::Vec3) || has_kind(variable, ValueKind::Vec2) ||
      has_kind(variable, ValueKind::Real);
  if (variable->kind != ExprKind::Embedding || !differentiable)
    return type_mismatch(variable->span,
                         "`grad` differentiates with respect to a real or vector embedding read "
                         "at a dart, as in `grad(E, a.position)`");
  check_differentiable(value, "this", context_);
  return make(ExprKind::Grad, variable->type, quotient_unit(*value, *variable), span,
              {value, variable});
}

ExprPtr ExprChecker::frozen_form(const syntax::CallExpr& expr, Span span) {
  const ExprPtr value = settle(check(expr.arguments[0]));
  if (is_error(value) || is_literal(value)) return value;
  if (!is_storable(value->type))
    return type_mismatch(value->span, "`frozen` takes a value, this is " + found_text(value));
  return make(ExprKind::Frozen, value->type, value->unit, span, {value});
}

ExprPtr ExprChecker::polygon_form(const syntax::CallExpr& expr, Span span) {
  if (context_.n() < 2) {
    context_.absent(DiagnosticKind::Dimension, expr.callee.span, "there is no face in dimension 1");
    return make_error(span);
  }
  const ExprPtr dart = check_dart(expr.arguments[0], "`polygon`");
  if (is_error(dart) && !context_.dart_uses) return make_error(span);
  return make(ExprKind::Polygon, {ValueKind::Darts}, {}, span, {dart});
}

}  // namespace gmsim::check
