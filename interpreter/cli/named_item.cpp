// SPDX-License-Identifier: MIT
#include "cli/named_item.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "engine/tree_eval.h"
#include "support/suggest.h"

namespace gmsim::cli {
namespace {

using support::DiagnosticKind;

bool mentions(const types::Expr& expr, types::Slot slot) {
  if (expr.kind == types::ExprKind::Local && expr.slot == slot) return true;
  return std::any_of(expr.args.begin(), expr.args.end(),
                     [slot](const types::ExprPtr& part) { return mentions(*part, slot); });
}

void report_unknown(const check::CheckedRules& rules, const compile::Program& program,
                    Session& session) {
  const std::string& name = session.options.rule;
  std::string help = rules.why_absent(name, program.dimension);
  if (help.empty()) {
    std::vector<std::string> names;
    for (const auto& rule : program.rules) names.push_back(rule.name);
    for (const auto& operation : program.operations) names.push_back(operation.name);
    help = support::did_you_mean(name, names);
    if (help.empty()) help = "`gmsim list rules` and `gmsim list operations` show what there is";
  }
  session.diagnostics.report(
      {.kind = DiagnosticKind::UnknownItem,
       .message = fmt::format("no rule or operation named `{}` for maps of dimension {}", name,
                              program.dimension),
       .help = help});
}

/// One `NAME=VALUE`; adds to `arguments` or reports.
void read_argument(const std::string& text, const NamedItem& item,
                   const check::CheckedRules& rules, const engine::State& state, Session& session,
                   engine::Arguments& arguments) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const compile::Parameter* parameter = item.head().find_parameter(name);
  if (equals == std::string::npos || parameter == nullptr) {
    std::vector<std::string> names;
    for (const auto& known : item.head().parameters) names.push_back(known.name);
    session.diagnostics.report(
        {.kind = equals == std::string::npos ? DiagnosticKind::Usage : DiagnosticKind::UnknownName,
         .message = equals == std::string::npos
                        ? fmt::format("`--param {}` is not NAME=VALUE", text)
                        : fmt::format("`{}` has no parameter `{}`", item.head().name, name),
         .help = names.empty() ? fmt::format("`{}` has no parameters", item.head().name)
                               : fmt::format("its parameters are {}", fmt::join(names, ", "))});
    return;
  }
  const auto file = session.sources.add("--param " + name, text.substr(equals + 1));
  const check::CheckedExpression value = check::check_expression(
      rules, state.program.dimension, file, parameter->type, session.sources, session.diagnostics);
  if (!value.value) return;
  if (parameter->unit && value.value->unit && !value.value->unit->dimensionless() &&
      !(*parameter->unit == *value.value->unit)) {
    session.diagnostics.report({.kind = DiagnosticKind::UnitMismatch,
                                .message = fmt::format("`{}` is in [{}], not in [{}]", name,
                                                       types::to_string(*parameter->unit),
                                                       types::to_string(*value.value->unit)),
                                .place = value.value->span});
    return;
  }
  if (mentions(*value.value, value.dart)) {
    session.diagnostics.report({.kind = DiagnosticKind::NotConstant,
                                .message = fmt::format("`{}` is read once, before there is a dart `a`", name),
                                .place = value.value->span});
    return;
  }
  engine::TreeEvaluator evaluator(state);
  engine::Frame frame(value.frame_size);
  if (auto constant = evaluator.evaluate(*value.value, frame))
    arguments.emplace_back(parameter->slot, std::move(*constant));
  else
    session.diagnostics.report(evaluator.take_failure().diagnostic);
}

void report_missing(const NamedItem& item, const engine::Arguments& arguments, Session& session) {
  for (const compile::Parameter& parameter : item.head().parameters) {
    const bool given = std::any_of(arguments.begin(), arguments.end(), [&](const auto& argument) {
      return argument.first == parameter.slot;
    });
    if (given || parameter.default_value) continue;
    session.diagnostics.report(
        {.kind = DiagnosticKind::MissingValue,
         .message = fmt::format("`{}` needs its parameter `{}`", item.head().name, parameter.name),
         .help = fmt::format("give it with `--param {}=VALUE`, {}{}", parameter.name,
                             types::to_string(parameter.type),
                             parameter.unit ? " [" + types::to_string(*parameter.unit) + "]" : "")});
  }
}

}  // namespace

std::string NamedItem::describe(const engine::MatchFailure& failure) const {
  return rule ? engine::describe(failure, rule->match)
              : "a rule in it does not match";
}

std::optional<NamedItem> find_named_item(const check::CheckedRules& rules,
                                         const compile::Program& program, Session& session) {
  NamedItem item;
  item.rule = program.find_rule(session.options.rule);
  if (!item.rule) item.operation = program.find_operation(session.options.rule);
  if (item.rule || item.operation) return item;
  report_unknown(rules, program, session);
  return std::nullopt;
}

bool read_arguments(const NamedItem& item, const check::CheckedRules& rules,
                    const engine::State& state, Session& session, engine::Arguments& arguments) {
  for (const std::string& text : session.options.parameters)
    read_argument(text, item, rules, state, session, arguments);
  if (session.diagnostics.has_errors()) return false;
  report_missing(item, arguments, session);
  return !session.diagnostics.has_errors();
}

}  // namespace gmsim::cli
