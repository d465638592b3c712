// SPDX-License-Identifier: MIT
// Operations: sequences of let, assignment, for, if and apply.
#include <algorithm>
#include <set>
#include <utility>

#include "check/change_target.h"
#include "check/check_expr.h"
#include "check/item_checks.h"
#include "check/statements.h"
#include "support/suggest.h"

namespace gmsim::check {
using support::DiagnosticKind;
namespace {

class OperationChecker {
 public:
  OperationChecker(ItemContext& context, const syntax::OperationItem& item)
      : context_(context), item_(item) {}

  Operation run() {
    context_.allow_all = true;
    if (const auto orbit = resolve_orbit(context_, item_.orbit)) operation_.orbit = *orbit;
    operation_.dart =
        context_.declare_slot(item_.dart, Binding::Kind::Node, {ValueKind::Dart})->slot;
    // Parameters first: their defaults read the dart and each other only.
    for (const syntax::Statement& statement : item_.body)
      if (const auto* param = std::get_if<syntax::ParamStatement>(&statement.node)) {
        reject_behaviour(context_, *param);
        operation_.parameters.push_back(check_parameter(context_, *param, {}));
      }
    check_statement_kinds(context_, item_.body, "an operation",
                          {"dimension", "param", "let", "assignment", "for", "if", "apply"});
    add_all(item_.body, operation_.body);
    return std::move(operation_);
  }

 private:
  using Body = std::vector<OperationStatement>;

  void add_all(const std::vector<syntax::Statement>& statements, Body& body) {
    const std::size_t outer = context_.scope.size();
    for (const syntax::Statement& statement : statements) {
      if (context_.absence) break;
      add(statement, body);
    }
    // Names of the operation's own level stay for the parameters' sake only.
    context_.scope.shrink(outer);
  }

  void add_nested(const std::vector<syntax::Statement>& statements, std::string_view where,
                  Body& body) {
    check_statement_kinds(context_, statements, where,
                          {"let", "assignment", "for", "if", "apply"});
    add_all(statements, body);
  }

  void add(const syntax::Statement& statement, Body& body) {
    if (const auto* let = std::get_if<syntax::LetStatement>(&statement.node)) {
      // A walk is taken when the statement is reached, so it is a value here.
      if (auto step = ExprChecker(context_).check_let(*let, statement.span, false))
        body.push_back({statement.span, OpLet{step->slot, step->value}});
    }
    if (const auto* assign = std::get_if<syntax::AssignStatement>(&statement.node))
      add_assign(*assign, statement.span, body);
    if (const auto* loop = std::get_if<syntax::ForStatement>(&statement.node))
      add_for(*loop, statement.span, body);
    if (const auto* choice = std::get_if<syntax::IfStatement>(&statement.node))
      add_if(*choice, statement.span, body);
    if (const auto* apply = std::get_if<syntax::ApplyStatement>(&statement.node))
      add_apply(*apply, statement.span, body);
  }

  void add_for(const syntax::ForStatement& loop, Span span, Body& body) {
    ExprChecker checker(context_);
    OpFor result;
    result.collection = checker.check_collection(loop.collection);
    if (has_kind(result.collection, ValueKind::Forces))
      context_.report({.kind = DiagnosticKind::TypeMismatch,
                       .message = "`for` goes over darts or a range, this is a collection of forces",
                       .place = result.collection->span});
    const std::size_t outer = context_.scope.size();
    result.variable = checker.declare_variable(loop.variable, result.collection)->slot;
    if (loop.condition) result.condition = checker.check_condition(loop.condition, "`where`");
    add_nested(loop.body, "a `for`", result.body);
    context_.scope.shrink(outer);
    body.push_back({span, std::move(result)});
  }

  /// Of a constant condition only the branch taken is looked at.
  void add_if(const syntax::IfStatement& choice, Span span, Body& body) {
    OpIf result;
    result.condition = ExprChecker(context_).check_condition(choice.condition, "a condition");
    if (const auto known = constant_bool(result.condition)) {
      add_nested(*known ? choice.then_body : choice.else_body, "an `if`", body);
      return;
    }
    add_nested(choice.then_body, "an `if`", result.then_body);
    add_nested(choice.else_body, "an `if`", result.else_body);
    body.push_back({span, std::move(result)});
  }

  void add_assign(const syntax::AssignStatement& assign, Span span, Body& body) {
    ExprChecker checker(context_);
    const ExprPtr target = assign.target ? checker.check(*assign.target) : make_error(span);
    if (is_error(target)) return;
    if (target->kind != ExprKind::Embedding) {
      const bool component = target->kind == ExprKind::Component;
      context_.report({.kind = DiagnosticKind::BadAssignment,
                       .message = "this is no embedding of a dart",
                       .place = target->span,
                       .help = component ? "assign the whole vector" : "write `x.embedding = …`"});
      return;
    }
    const gmap::EmbeddingDecl& value = context_.env.library->schema[target->embedding];
    if (value.kind == gmap::EmbeddingKind::Derived) {
      context_.report({.kind = DiagnosticKind::BadAssignment,
                       .message = "`" + value.name + "` is derived from other values",
                       .place = target->span,
                       .related = {{value.span, "declared here"}},
                       .help = "assign what it is computed from"});
      return;
    }
    OpAssign result;
    result.dart = target->args[0];
    result.embedding = target->embedding;
    result.value = checker.check_as(
        assign.value, {.type = value.type, .unit = value.unit, .scale = value.unit_scale,
                       .what = "`" + value.name + "`"});
    body.push_back({span, std::move(result)});
  }

  // ---- apply ------------------------------------------------------------------------------------

  void add_apply(const syntax::ApplyStatement& apply, Span span, Body& body) {
    ExprChecker checker(context_);
    const auto target = find_change(context_, apply.rule);
    OpApply result;
    for (const syntax::ExprPtr& argument : apply.arguments)
      result.darts.push_back(checker.check_dart(argument, "`apply`"));
    if (!target) return;
    result.operation = target->operation;
    result.target = target->index;
    if (result.darts.size() != target->darts) {
      context_.report(
          {.kind = DiagnosticKind::ArgumentCount,
           .message = "`" + apply.rule.text + "` is applied to " + std::to_string(target->darts) +
                      (target->darts == 1 ? " dart" : " darts") + ", this gives " +
                      std::to_string(result.darts.size()),
           .place = apply.rule.span,
           .related = {{target->span, "declared here"}}});
      return;
    }
    bool all_known = true;
    for (const syntax::NamedArgument& argument : apply.parameters)
      all_known &= add_parameter(argument, *target, apply.rule.text, result);
    if (!all_known) return;
    for (const Parameter& parameter : *target->parameters)
      if (!parameter.default_value && std::ranges::none_of(apply.parameters, [&](const auto& given) {
            return given.name.text == parameter.name;
          }))
        context_.report({.kind = DiagnosticKind::ArgumentCount,
                         .message = "`" + apply.rule.text + "` needs a value for `" +
                                    parameter.name + "`",
                         .place = apply.rule.span,
                         .related = {{parameter.span, "declared here"}},
                         .help = "write `apply " + apply.rule.text + "(…; " + parameter.name +
                                 " = …);`"});
    body.push_back({span, std::move(result)});
  }

  bool add_parameter(const syntax::NamedArgument& argument, const ChangeTarget& target,
                     const std::string& rule, OpApply& apply) {
    const auto parameter =
        std::ranges::find(*target.parameters, argument.name.text, &Parameter::name);
    if (parameter == target.parameters->end()) {
      std::vector<std::string> names;
      for (const Parameter& known : *target.parameters) names.push_back(known.name);
      context_.report({.kind = DiagnosticKind::UnknownName,
                       .message = "`" + rule + "` has no parameter `" + argument.name.text + "`",
                       .place = argument.name.span,
                       .help = support::did_you_mean(argument.name.text, names)});
      return false;
    }
    const bool twice = std::ranges::any_of(
        apply.parameters, [&](const auto& given) { return given.first == parameter->slot; });
    if (twice) {
      context_.report({.kind = DiagnosticKind::DuplicateName,
                       .message = "`" + argument.name.text + "` is given twice",
                       .place = argument.name.span});
      return false;
    }
    const ExprPtr value = ExprChecker(context_).check_as(
        argument.value, {.type = parameter->type, .unit = parameter->unit,
                         .scale = parameter->unit_scale,
                         .what = "parameter `" + parameter->name + "`"});
    apply.parameters.emplace_back(parameter->slot, value);
    return true;
  }

  ItemContext& context_;
  const syntax::OperationItem& item_;
  Operation operation_;
};

void collect_applied(const std::vector<syntax::Statement>& body,
                     std::vector<const syntax::Name*>& names) {
  for (const syntax::Statement& statement : body) {
    if (const auto* apply = std::get_if<syntax::ApplyStatement>(&statement.node))
      names.push_back(&apply->rule);
    if (const auto* loop = std::get_if<syntax::ForStatement>(&statement.node))
      collect_applied(loop->body, names);
    if (const auto* choice = std::get_if<syntax::IfStatement>(&statement.node)) {
      collect_applied(choice->then_body, names);
      collect_applied(choice->else_body, names);
    }
  }
}

}  // namespace

std::vector<const syntax::Name*> applied_names(const syntax::OperationItem& item) {
  std::vector<const syntax::Name*> names;
  collect_applied(item.body, names);
  return names;
}

Operation check_operation(ItemContext& context, const ItemEntry& entry) {
  Operation operation =
      OperationChecker(context, std::get<syntax::OperationItem>(entry.item->node)).run();
  fill_head(operation, context, entry);
  return operation;
}

}  // namespace gmsim::check
