// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "scene/quantity.h"
#include "scene/read_run.h"
#include "support/field_name.h"

namespace gmsim::scene {
namespace {

using support::DiagnosticKind;
using types::ValueKind;

/// The orbit of an embedding that is read at `a` itself; `vertex` for everything else.
types::OrbitType natural_orbit(const SceneExpression& expression, const compile::Program& program) {
  const types::Expr& value = *expression.code.value;
  const bool at_a = value.kind == types::ExprKind::Embedding &&
                    value.args.at(0)->kind == types::ExprKind::Local &&
                    value.args[0]->slot == expression.code.dart;
  return at_a ? program.schema[value.embedding].orbit
              : types::OrbitType::cell(0, program.dimension);
}

/// A value that can be stored; reported otherwise.
bool storable(const SceneExpression& expression, ReadContext& context) {
  if (!expression.good()) return false;
  if (types::is_storable(expression.code.value->type)) return true;
  context.report(DiagnosticKind::TypeMismatch, expression.span,
                 fmt::format("a number, vector or matrix is needed, this is a {}",
                             types::to_string(expression.code.value->type)));
  return false;
}

std::optional<OutputField> read_field(const YamlNode& node, ReadContext& context) {
  const YamlNode* name = node.is_scalar() ? &node : node.find("name");
  const YamlNode* value = node.is_scalar() ? &node : node.find("value");
  if (name == nullptr || value == nullptr) return std::nullopt;
  const SceneExpression expression = context.expression(*value, {}, MayRead::Forces);
  if (!storable(expression, context)) return std::nullopt;
  OutputField field{.name = node.is_scalar() ? support::field_name(name->text) : name->text,
                    .text = expression.text,
                    .orbit = {},
                    .type = expression.code.value->type,
                    .unit = expression.code.value->unit,
                    .value = expression.code,
                    .span = value->span};
  if (!support::is_field_name(field.name)) {
    context.report(DiagnosticKind::WrongForm, name->span,
                   fmt::format("`{}` cannot be the name of a field", field.name),
                   fmt::format("`{}` can", support::field_name(field.name)));
    return std::nullopt;
  }
  if (field.name == "velocity" && field.text != "velocity") {
    context.report(DiagnosticKind::DuplicateName, name->span,
                   "every frame has a field `velocity` already", "choose another name");
    return std::nullopt;
  }
  if (const YamlNode* on = node.is_map() ? node.find("on") : nullptr) {
    const auto orbit = context.orbit(*on);
    if (!orbit) return std::nullopt;
    field.orbit = *orbit;
  } else {
    field.orbit = natural_orbit(expression, context.program);
  }
  return field;
}

/// Numbers of `equals`: one, or a list of components. `unit`: that of the compared value.
std::vector<double> read_numbers(const YamlNode& node, const types::MaybeUnit& unit,
                                 ReadContext& context) {
  std::vector<double> numbers;
  const auto read = [&](const YamlNode& item) {
    const auto value = read_quantity(item, unit, context.sources, context.diagnostics);
    numbers.push_back(value ? value->value : 0.0);
  };
  if (node.is_list())
    std::ranges::for_each(node.items, read);
  else
    read(node);
  return numbers;
}

class ExpectationReader {
 public:
  ExpectationReader(const YamlNode& section, ReadContext& context, double duration)
      : section_(section), context_(context), duration_(duration) {}

  bool read(Expectation& expectation, ExpectedPoint& point) {
    expectation.span = section_.span;
    read_point(point);
    read_time(expectation);
    const YamlNode* value = section_.find("value");
    const YamlNode* tears = section_.find("tears");
    if ((value == nullptr) == (tears == nullptr))
      return refuse(DiagnosticKind::MissingKey, section_.span,
                    value ? "this expects two things" : "this does not say what is compared",
                    "give either `value`, an expression, or `tears`, their number");
    return tears ? read_tears(*tears, expectation) : read_value(*value, expectation);
  }

 private:
  bool read_tears(const YamlNode& tears, Expectation& expectation) {
    for (const char* key : {"equals", "within", "at_least", "at_most", "body", "point"})
      if (const YamlNode* other = section_.find(key))
        return refuse(DiagnosticKind::UnknownKey, other->span,
                      fmt::format("`tears` takes no `{}`", key),
                      "the number behind `tears` is what must come out");
    expectation.counts_tears = true;
    expectation.text = "tears";
    expectation.span = tears.span;
    expectation.equals = {static_cast<double>(context_.integer(tears))};
    return true;
  }

  bool read_value(const YamlNode& value, Expectation& expectation) {
    const SceneExpression expression = context_.expression(value, {}, MayRead::Forces);
    if (!storable(expression, context_)) return false;
    expectation.span = value.span;
    expectation.text = expression.text;
    expectation.value = expression.code;
    const std::size_t components = component_count(expression);
    if (components == 0) return false;
    unit_ = expression.code.value->unit;
    return read_bounds(expectation, components);
  }

  /// 1 or 3; 0 (reported) for other types.
  std::size_t component_count(const SceneExpression& expression) {
    const types::ValueType& type = expression.code.value->type;
    if (type == types::ValueType{ValueKind::Real} || type == types::ValueType{ValueKind::Int})
      return 1;
    if (type == types::ValueType{ValueKind::Vec3}) return 3;
    context_.report(
        DiagnosticKind::TypeMismatch, expression.span,
        fmt::format("a number or a vec3 is compared, this is a {}", types::to_string(type)));
    return 0;
  }

  void read_point(ExpectedPoint& point) {
    point.body = context_.body(section_);
    point.span = section_.span;
    const YamlNode* number = section_.find("point");
    if (number == nullptr) return;
    point.point = context_.integer(*number);
    point.span = number->span;
    if (point.body || context_.body_names.size() < 2 || section_.find("body")) return;
    context_.report(
        DiagnosticKind::MissingKey, number->span, "there are several bodies that have such a point",
        fmt::format("say which with `body`: `{}`", fmt::join(context_.body_names, "`, `")));
  }

  void read_time(Expectation& expectation) {
    const YamlNode& at = *section_.find("at");
    expectation.at = at.text == "end" ? duration_ : context_.number(at);
    if (expectation.at > duration_)
      context_.report(DiagnosticKind::OutOfRange, at.span,
                      fmt::format("this is after the end, {} s", duration_));
  }

  std::optional<double> bound(std::string_view key) {
    const YamlNode* node = section_.find(key);
    if (node == nullptr) return std::nullopt;
    const auto value = read_quantity(*node, unit_, context_.sources, context_.diagnostics);
    return value ? std::optional(value->value) : std::nullopt;
  }

  bool read_bounds(Expectation& expectation, std::size_t components) {
    const YamlNode* equals = section_.find("equals");
    const auto within = bound("within");
    expectation.at_least = bound("at_least");
    expectation.at_most = bound("at_most");
    const bool bounded = expectation.at_least || expectation.at_most;
    if (equals == nullptr && !bounded)
      return refuse(DiagnosticKind::MissingKey, section_.span, "this does not say what is expected",
                    "give `equals` with `within`, `at_least` or `at_most`");
    if (bounded && components != 1)
      return refuse(DiagnosticKind::TypeMismatch, expectation.span,
                    "only numbers have bounds, this is a vector");
    if (equals == nullptr) return true;
    if (!within)
      return refuse(DiagnosticKind::MissingKey, equals->span,
                    "`equals` needs `within`, how far off it may be");
    expectation.within = *within;
    expectation.equals = read_numbers(*equals, unit_, context_);
    if (expectation.equals.size() == components) return true;
    return refuse(DiagnosticKind::TypeMismatch, equals->span,
                  fmt::format("the value has {} component{}, this has {}", components,
                              components == 1 ? "" : "s", expectation.equals.size()));
  }

  bool refuse(DiagnosticKind kind, support::Span place, std::string message,
              std::string help = {}) {
    context_.report(kind, place, std::move(message), std::move(help));
    return false;
  }

  const YamlNode& section_;
  ReadContext& context_;
  double duration_;
  types::MaybeUnit unit_;
};

}  // namespace

void read_output(const YamlNode& tree, ReadContext& context, Scene& scene) {
  for (const YamlNode& node : tree.find("output")->find("fields")->items) {
    auto field = read_field(node, context);
    if (!field) continue;
    const auto same = std::ranges::find(scene.output.fields, field->name, &OutputField::name);
    if (same != scene.output.fields.end())
      context.diagnostics.report({.kind = DiagnosticKind::DuplicateName,
                                  .message = fmt::format("two fields are called `{}`", field->name),
                                  .place = field->span,
                                  .related = {{same->span, "the other one"}}});
    scene.output.fields.push_back(std::move(*field));
  }
}

void read_expectations(const YamlNode& tree, ReadContext& context, Scene& scene, ScenePlan& plan) {
  for (const YamlNode& section : tree.find("expect")->items) {
    Expectation expectation;
    ExpectedPoint point;
    if (!ExpectationReader(section, context, scene.duration).read(expectation, point)) continue;
    scene.expectations.push_back(std::move(expectation));
    plan.expected.push_back(point);
  }
}

}  // namespace gmsim::scene
