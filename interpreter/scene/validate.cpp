// SPDX-License-Identifier: MIT
#include "scene/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <string>

#include "scene/quantity.h"
#include "scene/schema.h"
#include "support/suggest.h"
#include "types/value.h"

namespace gmsim::scene {
namespace {

using support::DiagnosticKind;
using support::Diagnostics;
using support::Span;

/// Doubles count up to here.
constexpr std::int64_t kLargestInteger = 9'007'199'254'740'991;

std::optional<std::int64_t> whole_number(const std::string& text) {
  std::int64_t value = 0;
  const char* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto read = std::from_chars(begin, text.data() + text.size(), value);
  if (read.ec != std::errc{} || read.ptr != text.data() + text.size()) return std::nullopt;
  return std::abs(value) <= kLargestInteger ? std::optional(value) : std::nullopt;
}

/// Could the key be a name of the rule language, or `interaction.parameter`?
bool is_name(const std::string& key) {
  const auto letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  return !key.empty() && std::isdigit(static_cast<unsigned char>(key[0])) == 0 &&
         std::ranges::all_of(key, [&](char c) { return letter(c) || c == '.'; });
}

/// The default of a row as a tree; it stands where the mapping stands that lacks it.
YamlNode default_value(std::string_view text, Span place) {
  YamlNode node;
  if (text == "{}") {
    node.kind = YamlNode::Kind::Map;
  } else if (text.starts_with('[')) {
    node.kind = YamlNode::Kind::List;
    text = text.substr(1, text.size() - 2);
    while (!text.empty()) {
      const std::size_t comma = std::min(text.find(", "), text.size());
      node.items.push_back(default_value(text.substr(0, comma), place));
      text.remove_prefix(std::min(comma + 2, text.size()));
    }
  } else {
    const bool quoted = text.starts_with('"');
    node = YamlNode::scalar(std::string(quoted ? text.substr(1, text.size() - 2) : text), place);
    node.plain = !quoted;
    node.exact = false;
  }
  node.is_default = true;
  node.span = place;
  return node;
}

class Validator {
 public:
  Validator(support::SourceMap& sources, Diagnostics& diagnostics)
      : sources_(sources), diagnostics_(diagnostics) {}

  /// A mapping whose keys have rows; `place` is what names it (a key, the first byte of an entry).
  bool section(YamlNode& node, const SchemaNode& schema, Span place) {
    if (!node.is_map()) return wrong_form(node, "a mapping", schema);
    Wrong wrong;
    std::erase_if(node.entries, [&](YamlEntry& entry) {
      const SchemaNode* known = schema.find(entry.key);
      if (known != nullptr && (known != schema.any_key.get() || is_name(entry.key)))
        return !value(entry, *known, wrong);
      unknown_key(entry, schema);
      return true;
    });
    complete(node, schema, place, wrong);
    return true;
  }

 private:
  /// Keys whose values were wrong: they are not missing too.
  using Wrong = std::vector<std::string>;

  void report(DiagnosticKind kind, Span place, std::string message, std::string help = {}) {
    diagnostics_.report(
        {.kind = kind, .message = std::move(message), .place = place, .help = std::move(help)});
  }

  // ---- keys -------------------------------------------------------------------------------------

  void unknown_key(const YamlEntry& entry, const SchemaNode& schema) {
    std::string help = support::did_you_mean(entry.key, schema.key_names());
    if (help.empty() && !is_name(entry.key))
      help = "put an expression that holds a comma or a colon in quotes";
    if (help.empty()) help = belongs_elsewhere(entry.key);
    if (help.empty() && !schema.keys.empty())
      help = fmt::format("keys here are `{}`", fmt::join(schema.key_names(), "`, `"));
    report(DiagnosticKind::UnknownKey, entry.key_span,
           fmt::format("there is no key `{}` here", entry.key), std::move(help));
  }

  /// Where a key stands in the schema, if in one place only.
  static std::string belongs_elsewhere(const std::string& key) {
    std::string found;
    for (const SchemaRow& row : schema_rows()) {
      if (row.path != key && !row.path.ends_with("." + key)) continue;
      if (!found.empty()) return {};
      found = row.path;
    }
    return found.empty() ? found : fmt::format("`{}` is a key of scenes", found);
  }

  /// Missing keys are asked for, defaults filled in; sections within get theirs.
  void complete(YamlNode& node, const SchemaNode& schema, Span place, const Wrong& wrong) {
    for (const auto& [key, child] : schema.keys) {
      if (node.find_entry(key) || child->row == nullptr || child->row->fallback.empty()) continue;
      if (!child->row->required()) {
        YamlEntry entry{key, place, default_value(child->row->fallback, place)};
        if (child->row->form == Form::Section) section(entry.value, *child, place);
        node.entries.push_back(std::move(entry));
      } else if (std::ranges::find(wrong, key) == wrong.end()) {
        report(DiagnosticKind::MissingKey, place, fmt::format("the key `{}` is missing", key),
               fmt::format("`{}`: {}", child->row->path, child->row->doc));
      }
    }
  }

  /// False: the entry is to be taken out, because nothing stands there or it is wrong.
  bool value(YamlEntry& entry, const SchemaNode& schema, Wrong& wrong) {
    if (entry.value.is_null()) return false;
    const bool good = check(entry.value, schema, entry.key_span);
    if (!good) wrong.push_back(entry.key);
    return good;
  }

  // ---- values -----------------------------------------------------------------------------------

  bool wrong_form(const YamlNode& node, std::string_view wanted, const SchemaNode& schema) {
    std::string help;
    if (wanted == "a mapping" && !schema.keys.empty())
      help = fmt::format("its keys are `{}`", fmt::join(schema.key_names(), "`, `"));
    report(DiagnosticKind::WrongForm, first_line(node.span),
           fmt::format("{} is needed here, this is {}", wanted, describe(node)), std::move(help));
    return false;
  }

  /// A place in one line reads better than a block.
  [[nodiscard]] Span first_line(Span span) const {
    const std::string_view text = sources_.text(span);
    const std::size_t end = text.find('\n');
    if (end != std::string_view::npos) span.end = span.begin + static_cast<std::uint32_t>(end);
    return span;
  }

  bool check(YamlNode& node, const SchemaNode& schema, Span place) {
    const Form form = schema.row == nullptr ? Form::Section : schema.row->form;
    switch (form) {
      case Form::Section:
        return section(node, schema, place);
      case Form::Named:
        return named(node, schema);
      case Form::List:
      case Form::FieldList:
        return list(node, schema);
      case Form::Text:
        return node.is_scalar() || wrong_form(node, describe(form), schema);
      case Form::Choice:
        return choice(node, schema);
      case Form::Boolean:
        return boolean(node, schema);
      case Form::Integer:
        return integer(node, schema);
      case Form::Number:
        return number(node, schema);
      case Form::NumberOrSection:
        return node.is_map() ? section(node, schema, place) : number(node, schema);
      case Form::Expression:
        return expression(node, schema);
      case Form::Value:
        return node.is_list() ? components(node, schema) : expression(node, schema);
      case Form::TextList:
      case Form::IntegerList:
      case Form::NumberList:
        return plain_list(node, schema, form);
      case Form::IntegerTable:
      case Form::NumberTable:
        return table(node, schema, form);
    }
    return false;
  }

  bool named(YamlNode& node, const SchemaNode& schema) {
    if (!node.is_map()) return wrong_form(node, "a mapping", schema);
    const std::size_t count = schema.allowed.count;
    if (count > 0 && node.entries.size() != count) {
      report(DiagnosticKind::WrongForm, first_line(node.span),
             fmt::format("one name is needed here, these are {}", node.entries.size()),
             "begin a new entry, with `-`, for each");
      return false;
    }
    Wrong wrong;
    std::erase_if(node.entries, [&](YamlEntry& entry) {
      const SchemaNode* known = schema.find(entry.key);
      if (!is_name(entry.key)) {
        unknown_key(entry, schema);
        return true;
      }
      // an interaction without parameters may be named alone
      if (entry.value.is_null() && known->row != nullptr && known->row->form == Form::Named)
        entry.value = default_value("{}", entry.key_span);
      return !value(entry, *known, wrong);
    });
    complete(node, schema, node.span, wrong);
    return true;
  }

  bool list(YamlNode& node, const SchemaNode& schema) {
    if (!node.is_list()) return wrong_form(node, describe(schema.row->form), schema);
    if (schema.row->required() && node.items.empty())
      report(DiagnosticKind::MissingKey, node.span, "this list is empty", std::string(schema.row->doc));
    const bool words = schema.row->form == Form::FieldList;
    std::erase_if(node.items, [&](YamlNode& item) {
      if (words && item.is_scalar()) return false;
      if (item.is_null()) return !wrong_form(item, "a mapping", *schema.entry);
      return !check(item, *schema.entry, first_byte(item));
    });
    return true;
  }

  static Span first_byte(const YamlNode& node) {
    return {node.span.file, node.span.begin, std::min(node.span.begin + 1, node.span.end)};
  }

  bool choice(const YamlNode& node, const SchemaNode& schema) {
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

  static std::string_view last_step(const SchemaNode& schema) {
    const std::string_view path = schema.row->path;
    const std::size_t dot = path.rfind('.');
    return dot == std::string_view::npos ? path : path.substr(dot + 1);
  }

  bool boolean(const YamlNode& node, const SchemaNode& schema) {
    if (node.is_scalar() && node.plain && (node.text == "true" || node.text == "false")) return true;
    if (looks_boolean(node)) return refuse_boolean(node);
    return wrong_form(node, describe(Form::Boolean), schema);
  }

  bool refuse_boolean(const YamlNode& node) {
    report(DiagnosticKind::WrongForm, node.span,
           fmt::format("`{}` is not taken for a truth value", node.text), "write `true` or `false`");
    return false;
  }

  bool integer(const YamlNode& node, const SchemaNode& schema) {
    const auto value = node.is_scalar() ? whole_number(node.text) : std::optional<std::int64_t>{};
    if (!value) return wrong_form(node, "a whole number", schema);
    const Allowed& allowed = schema.allowed;
    if (allowed.words.empty()) return in_bounds(node, static_cast<double>(*value), allowed, "");
    if (std::ranges::find(allowed.words, std::to_string(*value)) != allowed.words.end()) return true;
    report(DiagnosticKind::OutOfRange, node.span, fmt::format("`{}` cannot be {}", last_step(schema), *value),
           fmt::format("it is {}", fmt::join(allowed.words, ", ")));
    return false;
  }

  bool in_bounds(const YamlNode& node, double value, const Allowed& allowed, std::string_view unit) {
    if (!allowed.bound || value > *allowed.bound || (!allowed.strict && value == *allowed.bound))
      return true;
    report(DiagnosticKind::OutOfRange, node.span,
           fmt::format("this must be {} {}{}{}", allowed.strict ? "above" : "at least",
                       types::number_text(*allowed.bound), unit.empty() || unit == "*" ? "" : " ",
                       unit == "*" ? "" : unit));
    return false;
  }

  bool number(const YamlNode& node, const SchemaNode& schema) {
    const SchemaRow& row = *schema.row;
    const Allowed& allowed = schema.allowed;
    if (node.is_scalar() && std::ranges::find(allowed.words, node.text) != allowed.words.end())
      return true;
    if (!node.is_scalar() || !std::ranges::any_of(node.text, [](char c) { return c >= '0' && c <= '9'; })) {
      const std::string word = allowed.words.empty() ? "" : fmt::format(" or `{}`", allowed.words[0]);
      return wrong_form(node, std::string(describe(row.form)) + word, schema);
    }
    const auto value = read_quantity(node, schema.unit, sources_, diagnostics_);
    return value && in_bounds(node, value->value, allowed, row.unit);
  }

  bool expression(const YamlNode& node, const SchemaNode& schema) {
    if (!node.is_scalar()) return wrong_form(node, describe(schema.row->form), schema);
    return looks_boolean(node) ? refuse_boolean(node) : true;
  }

  bool components(const YamlNode& node, const SchemaNode& schema) {
    if (node.items.size() != 2 && node.items.size() != 3) {
      report(DiagnosticKind::WrongForm, node.span,
             fmt::format("a vector has 2 or 3 components, this list {}", node.items.size()));
      return false;
    }
    return std::ranges::all_of(node.items, [&](const YamlNode& item) {
      return item.is_scalar() || wrong_form(item, "a number or an expression", schema);
    });
  }

  bool plain_list(const YamlNode& node, const SchemaNode& schema, Form form) {
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

  bool entry(const YamlNode& item, const SchemaNode& schema, Form form) {
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

  bool table(const YamlNode& node, const SchemaNode& schema, Form form) {
    if (!node.is_list()) return wrong_form(node, describe(form), schema);
    return std::ranges::all_of(node.items, [&](const YamlNode& row) {
      return plain_list(row, schema, form);
    });
  }

  support::SourceMap& sources_;
  Diagnostics& diagnostics_;
};

}  // namespace

bool looks_boolean(const YamlNode& node) {
  static constexpr std::array<std::string_view, 18> kWords = {
      "yes", "Yes", "YES", "no", "No", "NO", "on", "On", "ON", "off", "Off", "OFF",
      "True", "TRUE", "False", "FALSE", "y", "Y"};
  return node.is_scalar() && node.plain && std::ranges::find(kWords, node.text) != kWords.end();
}

void validate_scene(YamlNode& scene, support::SourceMap& sources, Diagnostics& diagnostics) {
  Validator(sources, diagnostics)
      .section(scene, schema(), {scene.span.file, scene.span.begin,
                                 std::min(scene.span.begin + 1, scene.span.end)});
}

double number_of(const YamlNode& node, support::SourceMap& sources) {
  Diagnostics ignored;
  const auto value = read_quantity(node, std::nullopt, sources, ignored);
  return value ? value->value : 0.0;
}

}  // namespace gmsim::scene
