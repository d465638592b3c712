// SPDX-License-Identifier: MIT
#include "scene/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>

#include "scene/quantity.h"
#include "scene/schema.h"
#include "scene/validate_value.h"
#include "support/suggest.h"

namespace gmsim::scene {
namespace {

using support::DiagnosticKind;
using support::Diagnostics;
using support::Span;

/// Could the key be a name of the rule language, or `interaction.parameter`?
bool is_name(const std::string& key) {
  const auto letter = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
  };
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
      : values_(sources, diagnostics) {}

  /// A mapping whose keys have rows; `place` is what names it (a key, the first byte of an entry).
  bool section(YamlNode& node, const SchemaNode& schema, Span place) {
    if (!node.is_map()) return values_.wrong_form(node, "a mapping", schema);
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

  // ---- keys -------------------------------------------------------------------------------------

  void unknown_key(const YamlEntry& entry, const SchemaNode& schema) {
    std::string help = support::did_you_mean(entry.key, schema.key_names());
    if (help.empty() && !is_name(entry.key))
      help = "put an expression that holds a comma or a colon in quotes";
    if (help.empty()) help = belongs_elsewhere(entry.key);
    if (help.empty() && !schema.keys.empty())
      help = fmt::format("keys here are `{}`", fmt::join(schema.key_names(), "`, `"));
    values_.report(DiagnosticKind::UnknownKey, entry.key_span,
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
    if (found.empty()) return found;
    const std::size_t dot = found.rfind('.');
    if (dot == std::string::npos) return fmt::format("`{}` stands at the top of a scene", key);
    return fmt::format("`{}` belongs under `{}`", key, found.substr(0, dot));
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
        values_.report(DiagnosticKind::MissingKey, place,
                       fmt::format("the key `{}` is missing", key),
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
        return values_.text(node, schema);
      case Form::Choice:
        return values_.choice(node, schema);
      case Form::Boolean:
        return values_.boolean(node, schema);
      case Form::Integer:
        return values_.integer(node, schema);
      case Form::Number:
        return values_.number(node, schema);
      case Form::NumberOrSection:
        return node.is_map() ? section(node, schema, place) : values_.number(node, schema);
      case Form::Expression:
        return values_.expression(node, schema);
      case Form::Value:
        return node.is_list() ? values_.components(node, schema) : values_.expression(node, schema);
      case Form::TextList:
      case Form::IntegerList:
      case Form::NumberList:
        return values_.plain_list(node, schema, form);
      case Form::IntegerTable:
      case Form::NumberTable:
        return values_.table(node, schema, form);
    }
    return false;
  }

  bool named(YamlNode& node, const SchemaNode& schema) {
    if (!node.is_map()) return values_.wrong_form(node, "a mapping", schema);
    const std::size_t count = schema.allowed.count;
    if (count > 0 && node.entries.size() != count) {
      values_.report(DiagnosticKind::WrongForm, values_.first_line(node.span),
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
    if (!node.is_list()) return values_.wrong_form(node, describe(schema.row->form), schema);
    if (schema.row->required() && node.items.empty())
      values_.report(DiagnosticKind::MissingKey, node.span, "this list is empty",
                     std::string(schema.row->doc));
    const bool words = schema.row->form == Form::FieldList;
    std::erase_if(node.items, [&](YamlNode& item) {
      if (words && item.is_scalar()) return false;
      if (item.is_null()) return !values_.wrong_form(item, "a mapping", *schema.entry);
      return !check(item, *schema.entry, first_byte(item));
    });
    return true;
  }

  static Span first_byte(const YamlNode& node) {
    return {node.span.file, node.span.begin, std::min(node.span.begin + 1, node.span.end)};
  }

  ValueValidator values_;
};

}  // namespace

void validate_scene(YamlNode& scene, support::SourceMap& sources, Diagnostics& diagnostics) {
  Validator(sources, diagnostics)
      .section(scene, schema(),
               {scene.span.file, scene.span.begin, std::min(scene.span.begin + 1, scene.span.end)});
}

double number_of(const YamlNode& node, support::SourceMap& sources) {
  Diagnostics ignored;
  const auto value = read_quantity(node, std::nullopt, sources, ignored);
  return value ? value->value : 0.0;
}

}  // namespace gmsim::scene
