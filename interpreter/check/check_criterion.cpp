// SPDX-License-Identifier: MIT
// Criteria: on an orbit with a pattern of their own, or of an interaction, whose names they read.
#include <algorithm>
#include <map>
#include <utility>

#include "check/build_pattern.h"
#include "check/change_target.h"
#include "check/check_expr.h"
#include "check/item_checks.h"
#include "check/passes.h"
#include "check/statements.h"

namespace gmsim::check {
using support::DiagnosticKind;
namespace {

class CriterionChecker {
 public:
  CriterionChecker(ItemContext& context, const syntax::CriterionItem& item,
                   const InteractionDraft* of)
      : context_(context), item_(item), of_(of) {}

  Criterion run() {
    if (of_)
      take_over();
    else
      build_own();
    if (!context_.good()) return std::move(criterion_);
    declare_threshold();
    bool has_value = false;
    for (const syntax::Statement& statement : item_.body) {
      if (context_.absence) break;
      has_value |= std::holds_alternative<syntax::ValueStatement>(statement.node);
      add(statement);
    }
    if (!has_value)
      context_.report({.kind = DiagnosticKind::BadItem,
                       .message = "criterion `" + item_.name.text + "` has no `value`",
                       .place = item_.name.span});
    if (criterion_.value) criterion_.parameters.front().unit = threshold_unit();
    if (of_ && context_.good()) drop_unused_steps();
    return std::move(criterion_);
  }

 private:
  void build_own() {
    check_statement_kinds(context_, item_.body, "a criterion",
                          {"dimension", "match", "param", "let", "where", "value", "result", "apply"});
    if (const auto orbit = resolve_orbit(context_, item_.orbit)) criterion_.orbit = *orbit;
    PatternBuilder builder(context_, syntax::SideKind::Match);
    const auto* match = find_side(item_.body, syntax::SideKind::Match);
    if (match)
      builder.add(match->block);
    else
      builder.add_node(item_.dart);
    criterion_.match = builder.take();
    declare_nodes(context_, criterion_.match);
    const auto hook = criterion_.match.find(item_.dart.text);
    if (!hook) {
      if (context_.good())
        context_.report({.kind = DiagnosticKind::BadItem,
                         .message = "`match` does not name `" + item_.dart.text +
                                    "`, the dart that the criterion is on",
                         .place = item_.dart.span,
                         .related = {{match->block.span, "the pattern"}}});
      return;
    }
    criterion_.hook = *hook;
    criterion_.dart = criterion_.match.nodes[*hook].slot;
    if (context_.good())
      check_match(criterion_.match, criterion_.hook, context_.n(), context_.diagnostics);
  }

  /// The interaction's pattern, its lets and, read where they are stored, its parameters.
  void take_over() {
    check_statement_kinds(context_, item_.body, "a criterion of an interaction",
                          {"dimension", "param", "let", "where", "value", "result", "apply"});
    const Interaction& law = of_->result;
    criterion_.interaction = law.id;
    criterion_.orbit = law.orbit;
    criterion_.match = law.match;
    criterion_.hook = law.hook;
    criterion_.dart = law.dart;
    context_.slot_names = of_->context.slot_names;
    context_.slot_scales = of_->context.slot_scales;
    for (const Parameter& parameter : law.parameters) stored(parameter.slot, *parameter.embedding);
    for (const Result& result : law.results) stored(result.slot, *result.embedding);
    for (const Step& step : law.steps)
      criterion_.steps.push_back({step.kind, step.slot, with_stored(step.value)});
    for (Binding binding : of_->context.scope.bindings()) {
      if (binding.value) binding.value = with_stored(binding.value);
      context_.scope.add(std::move(binding));
    }
  }

  void stored(Slot slot, EmbeddingId embedding) {
    const gmap::EmbeddingDecl& value = context_.env.library->schema[embedding];
    types::Expr read{.kind = ExprKind::Embedding, .type = value.type, .unit = value.unit,
                     .span = value.span};
    read.args = {make_local(criterion_.dart, {ValueKind::Dart}, {}, value.span)};
    read.embedding = embedding;
    stored_[slot] = std::make_shared<const types::Expr>(std::move(read));
  }

  ExprPtr with_stored(const ExprPtr& expr) const {
    return transform(expr, [&](const types::Expr& node) -> ExprPtr {
      if (node.kind != ExprKind::Local) return nullptr;
      const auto found = stored_.find(node.slot);
      return found == stored_.end() ? nullptr : with_span(found->second, node.span);
    });
  }

  void declare_threshold() {
    const syntax::Name name{"threshold", item_.name.span};
    Parameter threshold{.name = "threshold", .type = {ValueKind::Real}, .unit = {}, .slot = {},
                        .default_value = nullptr, .embedding = {}, .span = item_.name.span};
    if (const Binding* taken = context_.scope.find("threshold")) {
      context_.report({.kind = DiagnosticKind::DuplicateName,
                       .message = "every criterion has a parameter `threshold` of its own",
                       .place = taken->span});
      return;
    }
    threshold.slot =
        context_.declare_slot(name, Binding::Kind::Parameter, threshold.type)->slot;
    criterion_.parameters.push_back(std::move(threshold));
  }

  types::MaybeUnit threshold_unit() const {
    return adopts_unit(*criterion_.value) ? types::MaybeUnit(types::Unit{})
                                          : criterion_.value->unit;
  }

  void add(const syntax::Statement& statement) {
    ExprChecker checker(context_);
    if (const auto* where = std::get_if<syntax::WhereStatement>(&statement.node))
      criterion_.steps.push_back(
          {Step::Kind::Where, {}, checker.check_condition(where->condition, "`where`")});
    if (const auto* let = std::get_if<syntax::LetStatement>(&statement.node))
      if (auto step = checker.check_let(*let, statement.span, true))
        criterion_.steps.push_back(*step);
    if (const auto* param = std::get_if<syntax::ParamStatement>(&statement.node)) {
      reject_behaviour(context_, *param);
      criterion_.parameters.push_back(check_parameter(context_, *param, criterion_.steps));
    }
    if (const auto* value = std::get_if<syntax::ValueStatement>(&statement.node))
      criterion_.value =
          checker.check_as(value->value, {.type = {ValueKind::Real}, .what = "a value"});
    if (const auto* result = std::get_if<syntax::ResultStatement>(&statement.node))
      criterion_.results.push_back(check_result(context_, *result));
    if (const auto* apply = std::get_if<syntax::ApplyStatement>(&statement.node))
      set_default(*apply, statement.span);
  }

  // ---- what is done by default ------------------------------------------------------------------

  void bad_default(Span place, std::string message, std::string help) {
    context_.report({.kind = DiagnosticKind::BadItem,
                     .message = std::move(message),
                     .place = place,
                     .help = std::move(help)});
  }

  /// `apply CHANGE(node);`: its parameters are results of the criterion, or come from the scene.
  void set_default(const syntax::ApplyStatement& apply, Span span) {
    const std::string& name = apply.rule.text;
    if (criterion_.change)
      return bad_default(span, "a criterion has one default", "an operation may apply several rules");
    if (!apply.parameters.empty())
      return bad_default(apply.parameters.front().name.span,
                         "what a criterion applies takes its parameters from the criterion's results",
                         "write `result " + apply.parameters.front().name.text + " = …;`");
    const auto target = find_change(context_, apply.rule);
    if (!target) return;
    if (target->darts != 1)
      return bad_default(apply.rule.span,
                         "`" + name + "` has " + std::to_string(target->darts) +
                             " hooks, a criterion gives one",
                         "name a rule with one hook, or an operation");
    const auto* node = apply.arguments.size() == 1
                           ? std::get_if<syntax::NameExpr>(&apply.arguments[0]->node)
                           : nullptr;
    const auto found = node ? criterion_.match.find(node->name.text) : std::nullopt;
    if (!found)
      return bad_default(apply.arguments.empty() ? apply.rule.span : apply.arguments[0]->span,
                         "`" + name + "` is to be applied to one node of the pattern",
                         "write `apply " + name + "(" +
                             criterion_.match.nodes[criterion_.hook].name + ");`");
    criterion_.change = DefaultChange{target->operation, target->index, *found};
  }

  /// Of the interaction's lets those that the criterion reads; its conditions all hold.
  void drop_unused_steps() {
    std::set<Slot> wanted = slots_read(criterion_.value);
    for (const Result& result : criterion_.results) wanted.merge(slots_read(result.value));
    for (const Parameter& parameter : criterion_.parameters)
      if (parameter.default_value) wanted.merge(slots_read(parameter.default_value));
    std::vector<Step> kept;
    for (auto step = criterion_.steps.rbegin(); step != criterion_.steps.rend(); ++step) {
      if (step->kind == Step::Kind::Let && !wanted.contains(step->slot)) continue;
      wanted.merge(slots_read(step->value));
      kept.push_back(*step);
    }
    std::ranges::reverse(kept);
    criterion_.steps = std::move(kept);
  }

  ItemContext& context_;
  const syntax::CriterionItem& item_;
  const InteractionDraft* of_;
  Criterion criterion_;
  std::map<Slot, ExprPtr> stored_;
};

}  // namespace

Criterion check_criterion(ItemContext& context, const ItemEntry& entry,
                          const InteractionDraft* of) {
  Criterion criterion =
      CriterionChecker(context, std::get<syntax::CriterionItem>(entry.item->node), of).run();
  fill_head(criterion, context, entry);
  return criterion;
}

}  // namespace gmsim::check
