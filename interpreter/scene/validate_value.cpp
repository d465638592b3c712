// SPDX-License-Identifier: MIT
#include "scene/validate_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>

#include "scene/quantity.h"
#include "scene/validate.h"
#include "support/suggest.h"
#include "types/value.h"

namespace gmsim::scene {

using support::DiagnosticKind;
using support::Span;

namespace {

/// Doubles count up to here.
constexpr std::int64_t kLargestInteger = 9'007'199'254'740'991;

std::optional<std::int64_t> whole_number(const std::string& text) {
  std::int64_t value = 0;
  const char* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto read = std::from_chars(begin, text.data() + text.size(), value);
  if (read.ec != std::errc{} || read.ptr != text.data() + text.size()) return std::nullopt;
  return std::abs(value) <= kLargestInteger ? std::optional(value) : std::nullopt;
}

/// What messages call the key.
std::string_view last_step(const SchemaNode& schema) {
  const std::string_view path = schema.row->path;
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? path : path.substr(dot + 1);
}

}  // namespace

bool looks_boolean(const YamlNode& node) {
  static constexpr std::array<std::string_view, 18> kWords = {
      "yes", "Yes", "YES", "no",   "No",   "NO",    "on",    "On", "ON",
      "off", "Off", "OFF", "True", "TRUE", "False", "FALSE", "y",  "Y"};
  return node.is_scalar() && node.plain && std::ranges::find(kWords, node.text) != kWords.end();
}

void ValueValidator::report(DiagnosticKind kind, Span place, std::string message,
                            std::string help) {
  diagnostics_.report(
      {.kind = kind, .message = std::move(message), .place = place, .help = std::move(help)});
}

bool ValueValidator::text(const YamlNode& node, const SchemaNode& schema) {
  return node.is_scalar() || wrong_form(node, describe(Form::Text), schema);
}

bool ValueValidator::wrong_form(const YamlNode& node, std::string_view wanted,
                                const SchemaNode& schema) {
  std::string help;
  if (wanted == "a mapping" && !schema.keys.empty())
    help = fmt::format("its keys are `{}`", fmt::join(schema.key_names(), "`, `"));
  report(DiagnosticKind::WrongForm, first_line(node.span),
         fmt::format("{} is needed here, this is {}", wanted, describe(node)), std::move(help));
  return false;
}

Span ValueValidator::first_line(Span span) const {
  const std::string_view text = sources_.text(span);
  const std::size_t end = text.find('\n');
  if (end != std::string_view::npos) span.end = span.begin + static_cast<std::uint32_t>(end);
  return span;
}

bool ValueValidator::choice(const YamlNode& node, const SchemaNode& schema) {
  const std::vector<std::string>& words = schema.allowed.words;
  if (!node.is_scalar()) return wrong_form(node, describe(Form::Choice), schema);
  if (std::ranges::find(words, node.text) != words.end()) return true;
  const std::string guess = support::did_you_mean(node.text, words);
  report(DiagnosticKind::UnknownChoice, node.span,
         fmt::format("`{}` is none of the choices for `{}`", node.text, last_step(schema)),
         fmt::format("{} `{}`{}{}", words.size() == 1 ? "there is only" : "choices are",
                     fmt::join(words, "`, `"), guess.empty() ? "" : "; ", guess));
  return false;
}

bool ValueValidator::boolean(const YamlNode& node, const SchemaNode& schema) {
  if (node.is_scalar() && node.plain && (node.text == "true" || node.text == "false")) return true;
  if (looks_boolean(node)) return refuse_boolean(node);
  return wrong_form(node, describe(Form::Boolean), schema);
}

bool ValueValidator::refuse_boolean(const YamlNode& node) {
  report(DiagnosticKind::WrongForm, node.span,
         fmt::format("`{}` is not taken for a truth value", node.text), "write `true` or `false`");
  return false;
}

bool ValueValidator::integer(const YamlNode& node, const SchemaNode& schema) {
  const auto value = node.is_scalar() ? whole_number(node.text) : std::optional<std::int64_t>{};
  if (!value) return wrong_form(node, "a whole number", schema);
  const Allowed& allowed = schema.allowed;
  if (allowed.words.empty()) return in_bounds(node, static_cast<double>(*value), allowed, "");
  if (std::ranges::find(allowed.words, std::to_string(*value)) != allowed.words.end()) return true;
  report(DiagnosticKind::OutOfRange, node.span,
         fmt::format("`{}` cannot be {}", last_step(schema), *value),
         fmt::format("it is {}", fmt::join(allowed.words, ", ")));
  return false;
}

bool ValueValidator::in_bounds(const YamlNode& node, double value, const Allowed& allowed,
                               std::string_view unit) {
  if (!allowed.bound || value > *allowed.bound || (!allowed.strict && value == *allowed.bound))
    return true;
  report(DiagnosticKind::OutOfRange, node.span,
         fmt::format("this must be {} {}{}{}", allowed.strict ? "above" : "at least",
                     types::number_text(*allowed.bound), unit.empty() || unit == "*" ? "" : " ",
                     unit == "*" ? "" : unit));
  return false;
}

bool ValueValidator::number(const YamlNode& node, const SchemaNode& schema) {
  const SchemaRow& row = *schema.row;
  const Allowed& allowed = schema.allowed;
  if (node.is_scalar() && std::ranges::find(allowed.words, node.text) != allowed.words.end())
    return true;
  if (!node.is_scalar() ||
      !std::ranges::any_of(node.text, [](char c) { return c >= '0' && c <= '9'; })) {
    const std::string word = allowed.words.empty() ? "" : fmt::format(" or `{}`", allowed.words[0]);
    return wrong_form(node, std::string(describe(row.form)) + word, schema);
  }
  const auto value = read_quantity(node, schema.unit, sources_, diagnostics_);
  return value && in_bounds(node, value->value, allowed, row.unit);
}

bool ValueValidator::expression(const YamlNode& node, const SchemaNode& schema) {
  if (!node.is_scalar()) return wrong_form(node, describe(schema.row->form), schema);
  return looks_boolean(node) ? refuse_boolean(node) : true;
}

bool ValueValidator::components(const YamlNode& node, const SchemaNode& schema) {
  if (node.items.size() != 2 && node.items.size() != 3) {
    report(DiagnosticKind::WrongForm, node.span,
           fmt::format("a vector has 2 or 3 components, this list {}", node.items.size()));
    return false;
  }
  return std::ranges::all_of(node.items, [&](const YamlNode& item) {
    return item.is_scalar() || wrong_form(item, "a number or an expression", schema);
  });
}

bool ValueValidator::plain_list(const YamlNode& node, const SchemaNode& schema, Form form) {
  if (!node.is_list()) return wrong_form(node, describe(form), schema);
  const std::size_t count = schema.allowed.count;
  if (count > 0 && node.items.size() != count) {
    report(DiagnosticKind::WrongForm, node.span,
           fmt::format("this list must have {} entries, it has {}", count, node.items.size()));
    return false;
  }
  bool good = true;
  for (const YamlNode& item : node.items) good = entry(item, schema, form) && good;
  return good;
}

bool ValueValidator::entry(const YamlNode& item, const SchemaNode& schema, Form form) {
  switch (form) {
    case Form::IntegerList:
    case Form::IntegerTable:
      return integer(item, schema);
    case Form::NumberList:
    case Form::NumberTable:
      return number(item, schema);
    default:
      return item.is_scalar() || wrong_form(item, "a word", schema);
  }
}

bool ValueValidator::table(const YamlNode& node, const SchemaNode& schema, Form form) {
  if (!node.is_list()) return wrong_form(node, describe(form), schema);
  return std::ranges::all_of(node.items,
                             [&](const YamlNode& row) { return plain_list(row, schema, form); });
}

}  // namespace gmsim::scene
