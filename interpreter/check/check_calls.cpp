// SPDX-License-Identifier: MIT
// Calls: orbits, functions and macros (expanded), builtins.
#include <algorithm>
#include <limits>
#include <utility>

#include "check/check_expr.h"
#include "support/suggest.h"

namespace gmsim::check {
using support::DiagnosticKind;
using types::BuiltinInfo;
using types::Expr;
using types::MaybeUnit;
using types::Signature;
using types::Unit;
using types::UnitRule;
namespace {

std::string count_text(std::size_t count, const std::string& word) {
  return std::to_string(count) + " " + word + (count == 1 ? "" : "s");
}

/// An argument that stands in the body of a function as it is: cheap, and without effects.
bool stands_for_itself(const ExprPtr& argument) {
  return is_literal(argument) || is_walk(*argument) || argument->kind == ExprKind::Local ||
         has_kind(argument, ValueKind::Darts) || has_kind(argument, ValueKind::Forces) ||
         has_kind(argument, ValueKind::Range) || is_error(argument);
}

std::string signatures_text(const BuiltinInfo& info) {
  std::string text;
  for (const Signature& signature : info.signatures) {
    text += text.empty() ? "`" : " or `";
    text += std::string(info.name) + "(";
    for (std::size_t i = 0; i < signature.parameters.size(); ++i)
      text += (i > 0 ? ", " : "") + to_string(signature.parameters[i]);
    text += ")`";
  }
  return text;
}

struct Choice {
  std::size_t overload = 0;
  std::vector<ExprPtr> arguments;
};

/// How many conversions an overload needs; nothing when an argument does not fit, which is then
/// `misfit`.
std::optional<std::pair<int, std::vector<ExprPtr>>> try_overload(
    const Signature& signature, const std::vector<ExprPtr>& arguments, std::size_t& misfit) {
  int conversions = 0;
  std::vector<ExprPtr> converted;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    ExprPtr value = convert(arguments[i], signature.parameters[i]);
    if (!value) {
      misfit = i;
      return std::nullopt;
    }
    if (value != arguments[i]) ++conversions;
    converted.push_back(std::move(value));
  }
  return std::pair{conversions, std::move(converted)};
}

MaybeUnit root(const MaybeUnit& unit, int numerator, int denominator) {
  return unit ? types::power(*unit, numerator, denominator) : std::nullopt;
}

/// Unit of a builtin's result from its arguments, which agree already where the rule asks for it.
MaybeUnit result_unit(UnitRule rule, const std::vector<ExprPtr>& arguments) {
  const bool free = !arguments.empty() && std::ranges::all_of(arguments, [](const ExprPtr& arg) {
    return adopts_unit(*arg);
  });
  const auto first = [&]() -> MaybeUnit {
    for (const ExprPtr& argument : arguments)
      if (argument->unit) return argument->unit;
    return std::nullopt;
  };
  switch (rule) {
    case UnitRule::None:
    case UnitRule::Dimensionless:
    case UnitRule::Ratio:
    case UnitRule::Angle: return Unit{};
    case UnitRule::Same: return first();
    case UnitRule::First: return arguments.empty() ? Unit{} : arguments[0]->unit;
    case UnitRule::Root: return root(arguments[0]->unit, 1, 2);
    case UnitRule::Inverse:
      return arguments[0]->unit ? MaybeUnit(Unit{} / *arguments[0]->unit) : std::nullopt;
    case UnitRule::Cube:
      return root(arguments[0]->unit, has_kind(arguments[0], ValueKind::Mat2) ? 2 : 3, 1);
    case UnitRule::Product: break;
  }
  if (free) return std::nullopt;
  Unit product;
  for (const ExprPtr& argument : arguments) {
    const MaybeUnit unit = factor_unit(*argument);
    if (!unit) return std::nullopt;
    product = product * *unit;
  }
  return product;
}

}  // namespace

ExprPtr ExprChecker::call(const syntax::CallExpr& expr, Span span) {
  const std::string& callee = expr.callee.text;
  if (const Binding* local = context_.scope.find(callee);
      local && local->kind == Binding::Kind::Macro)
    return macro_call(*local, expr, span);
  if (auto result = form(expr, span)) return *result;
  if (names_orbit(context_, callee)) {
    const auto orbit = resolve_orbit_name(context_, expr.callee);
    if (!orbit || !check_count(expr, 1)) return make_error(span);
    return orbit_call(*orbit, expr.arguments[0], span);
  }
  if (const auto item = context_.env.items->find(NameSpace::Functions, callee, context_.n(),
                                                 context_.in_library))
    return function_call(*item, expr, span);
  if (const auto builtin = types::builtin(callee)) return builtin_call(*builtin, expr, span);
  return unknown_function(expr.callee);
}

ExprPtr ExprChecker::orbit_call(OrbitType type, const syntax::ExprPtr& argument, Span span) {
  if (!argument) {
    Expr orbit{.kind = ExprKind::Literal, .type = {ValueKind::Orbit}, .unit = {}, .span = span};
    orbit.orbit = type;
    return std::make_shared<const Expr>(std::move(orbit));
  }
  const ExprPtr dart = check_dart(argument, "an orbit");
  if (is_error(dart) && !context_.dart_uses) return make_error(span);
  Expr darts{.kind = ExprKind::OrbitDarts, .type = {ValueKind::Darts}, .unit = {}, .span = span};
  darts.args = {dart};
  darts.orbit = type;
  return make_expr(std::move(darts));
}

ExprPtr ExprChecker::unknown_function(const syntax::Name& name) {
  const ItemTable& items = *context_.env.items;
  if (const auto other = items.find_any(NameSpace::Functions, name.text)) {
    context_.absent(DiagnosticKind::Dimension, name.span,
                    "function `" + name.text + "` says `dimension " +
                        std::to_string(*items[*other].dimension) + ";`");
    return make_error(name.span);
  }
  std::string help;
  for (const NameSpace space : {NameSpace::Patterns, NameSpace::Rules, NameSpace::Operations,
                                NameSpace::Values, NameSpace::Criteria})
    if (const auto item = items.find_any(space, name.text); item && help.empty())
      help = "`" + name.text + "` is " + with_article(items[*item].kind);
  if (help.empty()) {
    std::vector<std::string> names = builtin_words();
    for (const std::string& function : items.names(NameSpace::Functions)) names.push_back(function);
    for (const OrbitName& orbit : context_.env.library->orbits) names.push_back(orbit.name);
    for (const Binding& binding : context_.scope.bindings())
      if (binding.kind == Binding::Kind::Macro) names.push_back(binding.name);
    help = support::did_you_mean(name.text, names);
  }
  context_.report_unknown({.kind = DiagnosticKind::UnknownFunction,
                           .message = "no function named `" + name.text + "`",
                           .place = name.span,
                           .help = std::move(help)});
  return make_error(name.span);
}

bool ExprChecker::check_count(const syntax::CallExpr& expr, std::size_t wanted) {
  if (expr.arguments.size() == wanted) return true;
  context_.report({.kind = DiagnosticKind::ArgumentCount,
                   .message = "`" + expr.callee.text + "` takes " +
                              count_text(wanted, "argument") + ", this gives " +
                              std::to_string(expr.arguments.size()),
                   .place = expr.callee.span});
  return false;
}

/// The checked arguments; nothing when one of them was reported.
std::optional<std::vector<ExprPtr>> ExprChecker::arguments(const syntax::CallExpr& expr) {
  std::vector<ExprPtr> values;
  bool good = true;
  for (const syntax::ExprPtr& argument : expr.arguments) {
    values.push_back(check(argument));
    good &= !is_error(values.back());
  }
  // A function checked by itself does not know what it is given.
  if (!good && !context_.dart_uses) return std::nullopt;
  return values;
}

// ---- builtins -----------------------------------------------------------------------------------

ExprPtr ExprChecker::builtin_call(types::Builtin builtin, const syntax::CallExpr& expr,
                                  Span span) {
  const BuiltinInfo& info = types::info(builtin);
  const auto given = arguments(expr);
  std::optional<Choice> best;
  int fewest = std::numeric_limits<int>::max();
  std::size_t misfit = 0;
  bool count_fits = false;
  for (std::size_t i = 0; i < info.signatures.size(); ++i) {
    const Signature& signature = info.signatures[i];
    if (signature.parameters.size() != expr.arguments.size()) continue;
    count_fits = true;
    if (!given) continue;
    std::size_t here = 0;
    auto fit = try_overload(signature, *given, here);
    misfit = std::max(misfit, here);
    if (!fit || fit->first >= fewest) continue;
    fewest = fit->first;
    best = Choice{i, std::move(fit->second)};
  }
  if (!count_fits) {
    check_count(expr, info.signatures.front().parameters.size());
    return make_error(span);
  }
  if (!given) return make_error(span);
  if (!best)
    return type_mismatch((*given)[misfit]->span,
                         "`" + expr.callee.text + "` cannot take " + found_text((*given)[misfit]),
                         "it is " + signatures_text(info));
  const Signature& signature = info.signatures[best->overload];
  std::vector<ExprPtr>& values = best->arguments;
  if (std::ranges::any_of(values, is_error)) {
    // Known only when a function is checked by itself; several overloads leave the type open.
    if (info.signatures.size() > 1) return make_error(span);
  } else if (info.units == UnitRule::Same || info.units == UnitRule::Ratio) {
    for (std::size_t round = 0; round < 2; ++round)
      for (std::size_t i = 1; i < values.size(); ++i)
        if (!unify_units(values[0], values[i], expr.callee.span,
                         "the arguments of `" + expr.callee.text + "` are in"))
          return make_error(span);
  } else if (info.units == UnitRule::None || info.units == UnitRule::Angle) {
    for (const ExprPtr& value : values)
      if (disagree(value->unit, Unit{})) {
        context_.report({.kind = DiagnosticKind::UnitMismatch,
                         .message = "`" + expr.callee.text + "` takes a number without unit, " +
                                    "this is in " + unit_text(value->unit),
                         .place = value->span,
                         .help = "divide it by a value in " + unit_text(value->unit)});
        return make_error(span);
      }
  }
  Expr call{.kind = ExprKind::Call, .type = signature.result,
            .unit = result_unit(info.units, values), .span = span};
  call.args = std::move(values);
  call.builtin = builtin;
  call.number = static_cast<std::int32_t>(best->overload);
  return make_expr(std::move(call));
}

// ---- functions and macros -----------------------------------------------------------------------

ExprPtr ExprChecker::function_call(ItemIndex item, const syntax::CallExpr& expr, Span span) {
  Environment& env = context_.env;
  const auto& function = std::get<syntax::FunctionItem>((*env.items)[item].item->node);
  if (env.definition_depth < kDeepestDefinition) {
    ++env.definition_depth;
    check_function(env, item, context_.sources);
    --env.definition_depth;
  }
  if (env.states[item].status == ItemStatus::InProgress) {
    context_.report({.kind = DiagnosticKind::RecursiveDefinition,
                     .message = "`" + expr.callee.text + "` is defined through itself",
                     .place = expr.callee.span,
                     .related = {{function.name.span, "defined here"}}});
    return make_error(span);
  }
  if (!context_.require(item, expr.callee.span)) return make_error(span);
  if (!check_count(expr, function.parameters.size())) return make_error(span);
  auto given = arguments(expr);
  if (!given) return make_error(span);
  const auto& uses = env.functions[item].dart_uses;
  for (std::size_t i = 0; i < given->size(); ++i) {
    const ExprPtr& argument = (*given)[i];
    if (i < uses.size() && uses[i] && is_error(argument)) {
      require_dart(argument, "`" + expr.callee.text + "`");
      continue;
    }
    if (i >= uses.size() || !uses[i] || has_kind(argument, ValueKind::Dart)) continue;
    context_.report({.kind = DiagnosticKind::TypeMismatch,
                     .message = "`" + expr.callee.text + "` takes a dart as `" +
                                function.parameters[i].text + "`, this is " + found_text(argument),
                     .place = argument->span,
                     .related = {{*uses[i], "used as a dart here"}}});
    return make_error(span);
  }
  const bool caller = std::exchange(context_.in_library, (*env.items)[item].library);
  ExprPtr value = expand(expr.callee, function.parameters, function.value, *given, Scope{}, span);
  context_.in_library = caller;
  return value;
}

ExprPtr ExprChecker::macro_call(const Binding& macro, const syntax::CallExpr& expr, Span span) {
  const syntax::LetStatement& let = *macro.macro;
  Scope scope = context_.scope.first(macro.visible);
  if (!check_count(expr, let.parameters->size())) return make_error(span);
  const auto given = arguments(expr);
  if (!given) return make_error(span);
  return expand(expr.callee, *let.parameters, let.value, *given, std::move(scope), span);
}

/// The body with its parameters bound: directly where an argument is a name or a walk, else by a Let
/// with a slot of its own, so that nothing is evaluated twice and no name is captured.
ExprPtr ExprChecker::expand(const syntax::Name& callee, const std::vector<syntax::Name>& parameters,
                            const syntax::ExprPtr& body, const std::vector<ExprPtr>& given,
                            Scope scope, Span span) {
  if (context_.expansions.size() >= kDeepestDefinition ||
      context_.env.definition_depth >= kDeepestDefinition) {
    context_.report({.kind = DiagnosticKind::TooDeep,
                     .message = "functions call functions more than " +
                                std::to_string(kDeepestDefinition) + " deep",
                     .place = span});
    context_.poison();
    return make_error(span);
  }
  std::vector<std::pair<Slot, ExprPtr>> lets;
  std::swap(context_.scope, scope);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    ExprPtr value = given[i];
    if (!stands_for_itself(value)) {
      value = settle(value);
      const Slot slot = context_.new_slot(parameters[i].text, declared_scale(*value));
      lets.emplace_back(slot, value);
      value = make_local(slot, value->type, value->unit, value->span);
    }
    context_.declare({.name = parameters[i].text, .kind = Binding::Kind::Argument, .value = value,
                      .span = parameters[i].span});
  }
  ExprPtr result;
  {
    const ExprPtr previous_bare = std::exchange(context_.bare_dart, nullptr);
    const bool previous_all = std::exchange(context_.allow_all, false);
    context_.expansions.push_back({callee.text, span});
    result = check(body);
    context_.expansions.pop_back();
    context_.bare_dart = previous_bare;
    context_.allow_all = previous_all;
  }
  std::swap(context_.scope, scope);
  for (auto let = lets.rbegin(); let != lets.rend(); ++let)
    if (!is_error(result)) result = make_let(let->first, let->second, result);
  return with_span(result, span);
}

void check_function(Environment& env, ItemIndex item, const support::SourceMap& sources) {
  ItemState& state = env.states[item];
  if (state.status != ItemStatus::Unchecked) return;
  state.status = ItemStatus::InProgress;
  const auto& function = std::get<syntax::FunctionItem>((*env.items)[item].item->node);
  ItemContext context(env, sources);
  std::vector<std::optional<Span>> dart_uses(function.parameters.size());
  context.dart_uses = &dart_uses;
  context.in_library = (*env.items)[item].library;
  for (std::size_t i = 0; i < function.parameters.size(); ++i) {
    const syntax::Name& name = function.parameters[i];
    context.declare({.name = name.text, .kind = Binding::Kind::Argument,
                     .value = make_local(context.new_slot(name.text), {ValueKind::Error}, {},
                                         name.span),
                     .span = name.span, .unknown_argument = i});
  }
  const ExprPtr value = ExprChecker(context).check(function.value);
  if (has_kind(value, ValueKind::Orbit))
    context.report({.kind = DiagnosticKind::TypeMismatch,
                    .message = "a function cannot give " + found_text(value),
                    .place = value->span});
  env.functions[item].dart_uses = std::move(dart_uses);
  state.diagnostics = context.diagnostics;
  state.absence = context.absence;
  state.status = context.absence  ? ItemStatus::Absent
                 : context.good() ? ItemStatus::Present
                                  : ItemStatus::Failed;
}

}  // namespace gmsim::check
