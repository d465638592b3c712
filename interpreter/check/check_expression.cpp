// SPDX-License-Identifier: MIT
// Expressions of scenes and of the command line.
#include "check/check.h"
#include "check/check_expr.h"
#include "check/checking.h"
#include "syntax/parse.h"

namespace gmsim::check {
using support::DiagnosticKind;
namespace {

/// Nodes that one such expression may have once its functions are expanded.
constexpr std::int64_t kNodeBudget = 200'000;

void check_type(ExprChecker& checker, ItemContext& context, const WantedValue& wanted,
                ExprPtr& value) {
  if (wanted.type.kind != ValueKind::Error) {
    value = checker.coerce(value, {.type = wanted.type, .unit = wanted.unit,
                                   .scale = wanted.unit_scale, .what = "the value"});
    return;
  }
  value = settle(value);
  const bool usable = is_error(value) || is_storable(value->type) ||
                      has_kind(value, ValueKind::Dart) || has_kind(value, ValueKind::Darts);
  if (!usable)
    context.report({.kind = DiagnosticKind::TypeMismatch,
                    .message = "a value is needed, this is " + found_text(value),
                    .place = value->span});
}

}  // namespace

CheckedExpression check_value_expression(const CheckedRules& rules, int dimension,
                                         support::FileId text, const WantedValue& wanted,
                                         support::SourceMap& sources,
                                         support::Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.error_count();
  const syntax::ExprPtr tree = syntax::parse_expression(sources, text, diagnostics);
  if (!tree || diagnostics.error_count() != errors) return {};
  Environment& env = checking_of(rules).environments.at(static_cast<std::size_t>(dimension - 1));
  env.node_budget = kNodeBudget;
  ItemContext context(env, sources);
  context.allow_all = true;
  context.bare_dart =
      context.declare_slot({"a", tree->span}, Binding::Kind::Node, {ValueKind::Dart});
  ExprChecker checker(context);
  ExprPtr value = checker.check(tree);
  check_type(checker, context, wanted, value);
  for (const support::Diagnostic& diagnostic : context.diagnostics.all())
    diagnostics.report(diagnostic);
  if (context.absence) diagnostics.report(*context.absence);
  if (!context.good() || is_error(value)) return {};
  return {.value = value, .dart = context.bare_dart->slot,
          .frame_size = static_cast<std::uint32_t>(context.slot_names.size()),
          .slot_names = context.slot_names};
}

CheckedExpression check_expression(const CheckedRules& rules, int dimension, support::FileId text,
                                   const types::ValueType& wanted, support::SourceMap& sources,
                                   support::Diagnostics& diagnostics) {
  return check_value_expression(rules, dimension, text, {.type = wanted}, sources, diagnostics);
}

}  // namespace gmsim::check
