// SPDX-License-Identifier: MIT
#include "check/value_kinds.h"

#include <map>
#include <string>

#include "check/check_expr.h"
#include "support/suggest.h"

namespace gmsim::check {
using gmap::EmbeddingKind;
using gmap::MergePolicy;
using support::DiagnosticKind;
namespace {

const std::map<std::string, MergePolicy>& policies() {
  static const std::map<std::string, MergePolicy> names = {
      {"equal", MergePolicy::Equal}, {"first", MergePolicy::First}, {"mean", MergePolicy::Mean},
      {"min", MergePolicy::Min},     {"max", MergePolicy::Max}};
  return names;
}

/// Real numbers, vectors and matrices, and arrays of them.
bool is_continuous(const ValueType& type) {
  return type.kind != ValueKind::Bool && type.kind != ValueKind::Int;
}

bool is_ordered(const ValueType& type) {
  return !type.is_array() && (type.kind == ValueKind::Bool || type.kind == ValueKind::Int ||
                              type.kind == ValueKind::Real);
}

MergePolicy resolve_policy(ItemContext& context, const syntax::MergeClause& clause,
                           const ValueType& type) {
  const auto found = policies().find(clause.policy.text);
  if (found == policies().end()) {
    std::vector<std::string> names;
    for (const auto& [name, policy] : policies()) names.push_back(name);
    std::string help = support::did_you_mean(clause.policy.text, names);
    if (help.empty()) help = "policies are `equal`, `first`, `mean`, `min` and `max`";
    context.report({.kind = DiagnosticKind::UnknownName,
                    .message = "no merge policy named `" + clause.policy.text + "`",
                    .place = clause.policy.span,
                    .help = std::move(help)});
    return MergePolicy::None;
  }
  const MergePolicy policy = found->second;
  const bool orders = policy == MergePolicy::Min || policy == MergePolicy::Max;
  if ((policy == MergePolicy::Mean && !is_continuous(type)) || (orders && !is_ordered(type)))
    context.report({.kind = DiagnosticKind::Conflict,
                    .message = "`merge " + clause.policy.text + "` does not work on " +
                               to_string(type),
                    .place = clause.policy.span});
  return policy;
}

}  // namespace

ValueBehaviour resolve_behaviour(ItemContext& context, const syntax::KindClause& kind,
                                 const std::optional<syntax::MergeClause>& merge,
                                 const ResolvedType& type) {
  ValueBehaviour behaviour;
  const bool extensive = kind.kind == syntax::KindClause::Kind::Extensive;
  if (extensive) behaviour.kind = EmbeddingKind::Extensive;
  if (extensive && !is_continuous(type.type))
    context.report({.kind = DiagnosticKind::Conflict,
                    .message = "a value of type " + to_string(type.type) +
                               " cannot be divided over the parts of a split",
                    .place = kind.span});
  if (extensive && merge)
    context.report({.kind = DiagnosticKind::Conflict,
                    .message = "an extensive value is summed on a merge; it has no other policy",
                    .place = merge->policy.span,
                    .related = {{kind.span, "extensive here"}}});
  if (!extensive && kind.split)
    context.report({.kind = DiagnosticKind::Conflict,
                    .message = "only an extensive value has a `split` weight",
                    .place = kind.split->span});
  if (merge && !extensive) behaviour.merge = resolve_policy(context, *merge, type.type);
  return behaviour;
}

void check_weight(Environment& env, const support::SourceMap& sources,
                  const syntax::KindClause& kind, const syntax::Name& dart,
                  gmap::EmbeddingDecl& declaration, ItemContext& report_to) {
  if (!kind.split || kind.kind != syntax::KindClause::Kind::Extensive) return;
  ItemContext context(env, sources);
  context.in_library = report_to.in_library;
  context.bare_dart =
      context.declare_slot(dart, Binding::Kind::Node, {ValueKind::Dart});
  ExprChecker checker(context);
  declaration.weight =
      checker.check_as(kind.split, {.type = {ValueKind::Real}, .what = "the weight of a split"});
  declaration.dart_slot = context.bare_dart->slot;
  declaration.frame_size = static_cast<std::uint32_t>(context.slot_names.size());
  for (const support::Diagnostic& diagnostic : context.diagnostics.all())
    report_to.diagnostics.report(diagnostic);
  if (context.absence && !report_to.absence) report_to.absence = context.absence;
  report_to.poisoned |= context.poisoned;
}

}  // namespace gmsim::check
