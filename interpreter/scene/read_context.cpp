// SPDX-License-Identifier: MIT
#include "scene/read_context.h"

#include <fmt/format.h>

#include <algorithm>

#include "compile/expression_search.h"
#include "engine/tree_eval.h"
#include "scene/expression_facts.h"
#include "scene/mapped_text.h"
#include "support/suggest.h"

namespace gmsim::scene {

using support::DiagnosticKind;
using support::Diagnostics;

void ReadContext::report(DiagnosticKind kind, support::Span place, std::string message,
                         std::string help) {
  diagnostics.report(
      {.kind = kind, .message = std::move(message), .place = place, .help = std::move(help)});
}

bool ReadContext::may_read(const types::Expr& expr, MayRead allowed) {
  using types::ExprKind;
  const auto first = [&](auto wanted) {
    const types::Expr* found = nullptr;
    (void)compile::any_node(expr, program.schema, [&](const types::Expr& node) {
      if (wanted(node.kind)) found = &node;
      return found != nullptr;
    });
    return found;
  };
  const types::Expr* force = first(
      [](ExprKind kind) { return kind == ExprKind::ForceOn || kind == ExprKind::Forces; });
  if (force != nullptr && allowed < MayRead::Forces) {
    report(DiagnosticKind::NotAvailable, force->span, "forces cannot be read here",
           "`where` and `threshold` of `tear`, output fields and `expect` read them");
    return false;
  }
  const types::Expr* derivative = first([](ExprKind kind) { return kind == ExprKind::Grad; });
  if (derivative == nullptr || allowed >= MayRead::Derivatives) return true;
  report(DiagnosticKind::NotAvailable, derivative->span, "derivatives cannot be taken here",
         "`grad` works in interactions and criteria");
  return false;
}

SceneExpression ReadContext::expression(const YamlNode& node, const check::WantedValue& wanted,
                                        MayRead allowed) {
  MappedText text = MappedText::of_value(sources, node);
  const support::FileId file = text.add_to(sources, sources.name(node.span.file));
  Diagnostics found;
  const check::CheckedExpression checked =
      check::check_value_expression(rules, dimension(), file, wanted, sources, found);
  text.report(found, diagnostics);
  SceneExpression result{.code = {text.map(checked.value), checked.dart, checked.frame_size},
                         .span = node.span,
                         .text = text.text()};
  if (found.has_errors()) result.code.value = nullptr;
  if (result.good() && !may_read(*result.code.value, allowed)) result.code.value = nullptr;
  if (result.good()) {
    result.constant = is_constant(*result.code.value);
    result.reads_clock = compile::reads_clock(*result.code.value, program.schema);
  }
  return result;
}

SceneExpression ReadContext::where(const YamlNode& section, MayRead allowed) {
  const YamlNode* node = section.find("where");
  if (node == nullptr) return {};
  return expression(*node, {.type = {types::ValueKind::Bool}}, allowed);
}

std::optional<types::Value> ReadContext::constant(const SceneExpression& expression,
                                                  const std::string& what) {
  if (!expression.good()) return std::nullopt;
  if (!expression.constant) {
    report(DiagnosticKind::NotConstant, expression.span,
           fmt::format("{} is one value for the whole run: it cannot read darts, values or time",
                       what));
    return std::nullopt;
  }
  const engine::State nothing(program, gmap::GMap(dimension()));
  engine::TreeEvaluator evaluator(nothing);
  engine::Frame frame(expression.code.frame_size);
  auto value = evaluator.evaluate(*expression.code.value, frame);
  if (!value) diagnostics.report(evaluator.take_failure().diagnostic);
  return value;
}

std::optional<std::size_t> ReadContext::body(const YamlNode& section) {
  const YamlNode* node = section.find("body");
  if (node == nullptr) return std::nullopt;
  const auto known = std::ranges::find(body_names, node->text);
  if (known != body_names.end()) return static_cast<std::size_t>(known - body_names.begin());
  const std::string guess = support::did_you_mean(node->text, body_names);
  report(DiagnosticKind::UnknownName, node->span, fmt::format("no body is called `{}`", node->text),
         guess.empty() ? fmt::format("bodies are `{}`", fmt::join(body_names, "`, `")) : guess);
  return std::nullopt;
}

std::optional<types::OrbitType> ReadContext::orbit(const YamlNode& node) {
  if (const auto named = library().find_orbit(node.text)) return named;
  const std::string& text = node.text;
  if (text.size() >= 2 && text.front() == '<' && text.back() == '>') {
    types::OrbitType type;
    bool good = true;
    for (std::size_t i = 1; i + 1 < text.size(); ++i) {
      const bool digit = text[i] >= '0' && text[i] <= '0' + dimension();
      good = good && (i % 2 == 1 ? digit : text[i] == ',');
      if (digit) type.insert(text[i] - '0');
    }
    if (good) return type;
  }
  const std::vector<std::string> names = names_of(library().orbits);
  const std::string guess = support::did_you_mean(text, names);
  report(DiagnosticKind::UnknownOrbit, node.span,
         fmt::format("no orbit named `{}` in dimension {}", text, dimension()),
         guess.empty()
             ? fmt::format("orbits are `{}`, or literal as in `<0,1>`", fmt::join(names, "`, `"))
             : guess);
  return std::nullopt;
}

void ReadContext::report_unknown_item(const YamlNode& node, const std::string& kind,
                                      const std::vector<std::string>& names) {
  report_unknown_item(node.text, node.span, kind, names);
}

void ReadContext::report_unknown_item(const std::string& name, support::Span span,
                                      const std::string& kind,
                                      const std::vector<std::string>& names) {
  std::string help = rules.why_absent(name, dimension());
  if (help.empty()) help = support::did_you_mean(name, names);
  if (help.empty())
    help = fmt::format(
        "`gmsim list {} --dimension {}` shows what there is; files of your own go under `rules:`",
        kind == "criterion" ? "criteria" : kind.substr(0, kind.find(' ')) + "s", dimension());
  report(DiagnosticKind::UnknownItem, span,
         fmt::format("no {} named `{}` in dimension {}", kind, name, dimension()), std::move(help));
}

}  // namespace gmsim::scene
