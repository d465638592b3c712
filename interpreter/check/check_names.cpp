// SPDX-License-Identifier: MIT
// Names and what stands after `.`: locals, embeddings, parameters and results of interactions.
#include <algorithm>
#include <array>
#include <utility>

#include "check/check_expr.h"
#include "support/suggest.h"

namespace gmsim::check {
using support::DiagnosticKind;
using types::Expr;
using types::Unit;
namespace {

constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};

const Unit& seconds() {
  static const Unit unit = types::named_unit("s")->unit;
  return unit;
}

ExprPtr clock(ExprKind kind, Span span) {
  const Unit unit = kind == ExprKind::Step ? Unit{} : seconds();
  return make_expr({.kind = kind, .type = {ValueKind::Real}, .unit = unit, .span = span});
}

bool is_component(std::string_view name) {
  return std::ranges::find(kAxes, name) != kAxes.end() || name == "value" || name == "vector";
}

}  // namespace

// ---- bare names ---------------------------------------------------------------------------------

ExprPtr ExprChecker::name(const syntax::NameExpr& expr, Span span) {
  const std::string& text = expr.name.text;
  if (const Binding* binding = context_.scope.find(text)) {
    if (binding->value) return with_span(binding->value, span);
    if (binding->kind == Binding::Kind::Macro)
      return type_mismatch(span, "`" + text + "` is a macro; it needs arguments",
                           "write `" + text + "(…)`");
    context_.report({.kind = DiagnosticKind::NewNodeRead,
                     .message = "node `" + text + "` does not exist before the rule is applied",
                     .place = span,
                     .related = {{binding->span, "created here"}},
                     .help = "expressions read the map as it was: name nodes of `left`"});
    return make_error(span);
  }
  if (text == "time") return clock(ExprKind::Time, span);
  if (text == "step") return clock(ExprKind::Step, span);
  if (text == "dt") return clock(ExprKind::Dt, span);
  if (context_.bare_dart && context_.env.items->find_any(NameSpace::Values, text))
    return embedding_read(context_.bare_dart, expr.name, span);
  if (names_orbit(context_, text)) {
    const auto type = resolve_orbit_name(context_, expr.name);
    if (!type) return make_error(span);
    Expr orbit{.kind = ExprKind::Literal, .type = {ValueKind::Orbit}, .unit = {}, .span = span};
    orbit.orbit = *type;
    return std::make_shared<const Expr>(std::move(orbit));
  }
  return unknown_name(expr.name);
}

ExprPtr ExprChecker::unknown_name(const syntax::Name& name) {
  const ItemTable& items = *context_.env.items;
  std::string help;
  if (items.find_any(NameSpace::Values, name.text)) {
    help = "`" + name.text + "` is read at a dart, as in `a." + name.text + "`";
  } else if (items.find_any(NameSpace::Functions, name.text) || is_builtin_word(name.text)) {
    help = "`" + name.text + "` is a function; write `" + name.text + "(…)`";
  } else {
    std::vector<std::string> names = {"time", "step", "dt"};
    for (const Binding& binding : context_.scope.bindings()) names.push_back(binding.name);
    if (context_.bare_dart)
      for (const auto& [known, ref] : context_.env.values) names.push_back(known);
    help = support::did_you_mean(name.text, names);
  }
  context_.report_unknown({.kind = DiagnosticKind::UnknownName,
                           .message = "nothing is named `" + name.text + "` here",
                           .place = name.span,
                           .help = std::move(help)});
  return make_error(name.span);
}

// ---- after the dot ------------------------------------------------------------------------------

bool ExprChecker::names_interaction(const std::string& name) const {
  const auto item = context_.env.items->find(NameSpace::Values, name, context_.n());
  if (!item) return false;
  const ItemKind kind = (*context_.env.items)[*item].kind;
  return kind == ItemKind::Interaction || kind == ItemKind::Family;
}

/// The dart and the name of `a.spring` in `a.spring.rest`, or of a bare `spring` in a scene.
std::optional<std::pair<ExprPtr, const syntax::Name*>> ExprChecker::interaction_owner(
    const syntax::Expr& object) {
  if (const auto* member = std::get_if<syntax::MemberExpr>(&object.node)) {
    if (!names_interaction(member->member.text)) return std::nullopt;
    return std::pair{check_dart(member->object, "`." + member->member.text + "`"),
                     &member->member};
  }
  if (const auto* bare = std::get_if<syntax::NameExpr>(&object.node)) {
    if (!context_.bare_dart || context_.scope.find(bare->name.text)) return std::nullopt;
    if (!names_interaction(bare->name.text)) return std::nullopt;
    return std::pair{context_.bare_dart, &bare->name};
  }
  return std::nullopt;
}

ExprPtr ExprChecker::member(const syntax::MemberExpr& expr, Span span) {
  if (expr.object)
    if (const auto owner = interaction_owner(*expr.object))
      return interaction_read(owner->first, *owner->second, expr.member, span);
  const ExprPtr object = check(expr.object);
  if (is_error(object)) {
    // The object's type may be unknown only because a function is checked by itself.
    if (!context_.dart_uses || is_component(expr.member.text)) return make_error(span);
    const ExprPtr dart = require_dart(object, "`." + expr.member.text + "`");
    return embedding_read(dart, expr.member, span);
  }
  if (has_kind(object, ValueKind::Dart)) return embedding_read(object, expr.member, span);
  return component(object, expr.member, span);
}

ExprPtr ExprChecker::component(const ExprPtr& object, const syntax::Name& name, Span span) {
  const auto axis = std::ranges::find(kAxes, name.text) - kAxes.begin();
  const bool vec2 = has_kind(object, ValueKind::Vec2), vec3 = has_kind(object, ValueKind::Vec3);
  if ((vec2 && axis < 2) || (vec3 && axis < 3)) {
    Expr part{.kind = ExprKind::Component, .type = {ValueKind::Real}, .unit = object->unit,
              .span = span};
    part.args = {object};
    part.number = static_cast<std::int32_t>(axis);
    return make_expr(std::move(part));
  }
  if (has_kind(object, ValueKind::EigenPair) && (name.text == "value" || name.text == "vector")) {
    const bool value = name.text == "value";
    Expr part{.kind = ExprKind::Component, .type = {value ? ValueKind::Real : ValueKind::Vec3},
              .unit = value ? object->unit : types::MaybeUnit(Unit{}), .span = span};
    part.args = {object};
    part.number = value ? 0 : 1;
    return make_expr(std::move(part));
  }
  std::string help;
  if (vec2) help = "a vec2 has `.x` and `.y`";
  if (vec3) help = "a vec3 has `.x`, `.y` and `.z`";
  if (has_kind(object, ValueKind::EigenPair)) help = "an eigenpair has `.value` and `.vector`";
  if (has_kind(object, ValueKind::Darts)) help = "go over its darts, as in `mean(x in … : x." +
                                                 name.text + ")`";
  return type_mismatch(name.span, "`." + name.text + "` is no part of " + found_text(object),
                       std::move(help));
}

ExprPtr ExprChecker::read(ExprKind kind, const ExprPtr& dart, EmbeddingId embedding, Span span) {
  const gmap::EmbeddingDecl& declaration = context_.env.library->schema[embedding];
  Expr expr{.kind = kind, .type = declaration.type, .unit = declaration.unit, .span = span};
  if (kind == ExprKind::Has) {
    expr.type = {ValueKind::Bool};
    expr.unit = std::nullopt;
  }
  expr.args = {dart};
  expr.embedding = embedding;
  return make_expr(std::move(expr));
}

ExprPtr ExprChecker::embedding_read(const ExprPtr& dart, const syntax::Name& name, Span span) {
  const auto ref = find_value_ref(name);
  if (!ref || (is_error(dart) && !context_.dart_uses)) return make_error(span);
  if (const auto* embedding = std::get_if<EmbeddingId>(&*ref))
    return read(ExprKind::Embedding, dart, *embedding, span);
  const bool family = std::holds_alternative<FamilyIndex>(*ref);
  return type_mismatch(name.span,
                       "`" + name.text + "` is " + (family ? "a family" : "an interaction") +
                           ", not a value",
                       "read a parameter or result of it, as in `a." + name.text +
                           ".stiffness`, or test `has(a." + name.text + ")`");
}

ExprPtr ExprChecker::interaction_read(const ExprPtr& dart, const syntax::Name& owner,
                                      const syntax::Name& member, Span span) {
  const auto ref = find_value_ref(owner);
  if (!ref || (is_error(dart) && !context_.dart_uses)) return make_error(span);
  if (const auto* family = std::get_if<FamilyIndex>(&*ref))
    return family_read(dart, context_.env.library->families[static_cast<std::size_t>(*family)],
                       member, span);
  const auto embedding = find_member(owner, member);
  return embedding ? read(ExprKind::Embedding, dart, *embedding, span) : make_error(span);
}

/// The value of the member that the orbit carries: a chain of `if has(a.m1) then a.m1.r else …`. The
/// last one is read without a test, so that an orbit that carries none lacks the value.
ExprPtr ExprChecker::family_read(const ExprPtr& dart, const Family& family,
                                 const syntax::Name& member, Span span) {
  ExprPtr chain;
  for (auto id = family.members.rbegin(); id != family.members.rend(); ++id) {
    const std::string& interaction = context_.env.library->interactions[types::index(*id)].name;
    const syntax::Name owner{interaction, member.span};
    const auto embedding = find_member(owner, member);
    if (!embedding) return make_error(span);
    ExprPtr value = read(ExprKind::Embedding, dart, *embedding, span);
    if (chain && (value->type != chain->type || disagree(value->unit, chain->unit)))
      return type_mismatch(member.span, "the members of `" + family.name + "` do not agree on `" +
                                            member.text + "`: " +
                                            type_text(value->type, value->unit) + " and " +
                                            type_text(chain->type, chain->unit));
    if (!chain) {
      chain = std::move(value);
      continue;
    }
    const auto presence = context_.env.library->schema.find(interaction);
    chain = make(ExprKind::If, chain->type, chain->unit ? chain->unit : value->unit, span,
                 {read(ExprKind::Has, dart, *presence, span), value, chain});
  }
  return chain ? chain : make_error(span);
}

// ---- finding ------------------------------------------------------------------------------------

std::string ExprChecker::describe_value(const std::string& name) const {
  const auto found = context_.env.values.find(name);
  if (found == context_.env.values.end()) return {};
  if (const auto* id = std::get_if<EmbeddingId>(&found->second)) {
    const gmap::EmbeddingDecl& value = context_.env.library->schema[*id];
    return "`" + name + "` (" + type_text(value.type, value.unit) + ", on " +
           orbit_text(value.orbit, context_.n()) + ", declared in " +
           context_.place_text(value.span) + ")";
  }
  return "`" + name + "` (" +
         (std::holds_alternative<FamilyIndex>(found->second) ? "a family" : "an interaction") + ")";
}

std::optional<ValueRef> ExprChecker::find_value_ref(const syntax::Name& name) {
  const auto found = context_.env.values.find(name.text);
  const auto item = context_.env.items->find(NameSpace::Values, name.text, context_.n());
  if (item && !context_.require(*item, name.span)) return std::nullopt;
  if (found != context_.env.values.end()) return found->second;
  if (item) {  // declared, but not known yet: reported where it is declared
    context_.poison();
    return std::nullopt;
  }
  if (const auto other = context_.env.items->find_any(NameSpace::Values, name.text)) {
    context_.absent(DiagnosticKind::Dimension, name.span,
                    "`" + name.text + "` says `dimension " +
                        std::to_string(*(*context_.env.items)[*other].dimension) + ";`");
    return std::nullopt;
  }
  std::vector<std::string> names;
  for (const auto& [known, ref] : context_.env.values) names.push_back(known);
  const std::vector<std::string> near = support::close_names(name.text, names);
  context_.report_unknown(
      {.kind = DiagnosticKind::UnknownEmbedding,
       .message = "no embedding named `" + name.text + "`",
       .place = name.span,
       .help = near.size() == 1 ? "did you mean " + describe_value(near[0]) + "?"
                                : support::did_you_mean(name.text, names)});
  return std::nullopt;
}

std::optional<EmbeddingId> ExprChecker::find_value(const syntax::Name& name) {
  const auto ref = find_value_ref(name);
  if (!ref) return std::nullopt;
  if (const auto* id = std::get_if<EmbeddingId>(&*ref)) return *id;
  return std::nullopt;
}

std::optional<EmbeddingId> ExprChecker::find_member(const syntax::Name& owner,
                                                    const syntax::Name& member) {
  if (!find_value_ref(owner)) return std::nullopt;
  const gmap::EmbeddingSchema& schema = context_.env.library->schema;
  if (const auto id = schema.find(owner.text + "." + member.text)) return id;
  std::vector<std::string> names;
  const std::string prefix = owner.text + ".";
  for (const gmap::EmbeddingDecl& value : schema)
    if (value.name.starts_with(prefix)) names.push_back(value.name.substr(prefix.size()));
  std::string help = support::did_you_mean(member.text, names);
  if (help.empty() && !names.empty()) {
    help = "it has ";
    for (std::size_t i = 0; i < names.size(); ++i)
      help += (i == 0 ? "`" : i + 1 == names.size() ? " and `" : ", `") + names[i] + "`";
  }
  context_.report_unknown({.kind = DiagnosticKind::UnknownEmbedding,
                           .message = "interaction `" + owner.text +
                                      "` has no parameter or result `" + member.text + "`",
                           .place = member.span,
                           .help = std::move(help)});
  return std::nullopt;
}

}  // namespace gmsim::check
