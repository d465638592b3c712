// SPDX-License-Identifier: MIT
#include "scene/schema.h"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "scene/quantity.h"
#include "support/check.h"

namespace gmsim::scene {
namespace {

/// The node of a key below `node`, made when it is new.
SchemaNode& below(SchemaNode& node, std::string_view key) {
  std::unique_ptr<SchemaNode>* place = nullptr;
  if (key == "*") {
    place = &node.any_key;
  } else if (key == "[]") {
    place = &node.entry;
  } else {
    const auto known = std::ranges::find(node.keys, key, &decltype(node.keys)::value_type::first);
    if (known != node.keys.end()) return *known->second;
    place = &node.keys.emplace_back(key, nullptr).second;
  }
  if (!*place) *place = std::make_unique<SchemaNode>();
  return **place;
}

/// "bodies[].mass" -> bodies, [], mass.
std::vector<std::string_view> steps(std::string_view path) {
  std::vector<std::string_view> result;
  while (!path.empty()) {
    const std::size_t end =
        path.starts_with("[]") ? 2 : std::min(path.find_first_of(".["), path.size());
    result.push_back(path.substr(0, end));
    path.remove_prefix(end);
    if (path.starts_with('.')) path.remove_prefix(1);
  }
  return result;
}

SchemaNode build_tree() {
  SchemaNode root;
  for (const SchemaRow& row : schema_rows()) {
    SchemaNode* node = &root;
    for (const std::string_view step : steps(row.path)) node = &below(*node, step);
    node->row = &row;
    node->allowed = allowed_by(row);
    if (row.unit != "*") node->unit = schema_unit(row.unit);
  }
  return root;
}

}  // namespace

std::string_view describe(Form form) {
  switch (form) {
    case Form::Section:
    case Form::Named:
      return "a mapping";
    case Form::List:
      return "a list of mappings";
    case Form::FieldList:
      return "a list of names or mappings";
    case Form::Text:
    case Form::Choice:
      return "a word";
    case Form::Boolean:
      return "`true` or `false`";
    case Form::Integer:
      return "a whole number";
    case Form::Number:
      return "a number";
    case Form::NumberOrSection:
      return "a number or a mapping";
    case Form::Expression:
      return "an expression";
    case Form::Value:
      return "a number, an expression or a list of components";
    case Form::TextList:
      return "a list of words";
    case Form::IntegerList:
      return "a list of whole numbers";
    case Form::NumberList:
      return "a list of numbers";
    case Form::IntegerTable:
      return "a list of lists of whole numbers";
    case Form::NumberTable:
      return "a list of lists of numbers";
  }
  return "";
}

const std::vector<SchemaRow>& schema_rows() {
  static const std::vector<SchemaRow> rows = {
#define SCENE_KEY(path, form, unit, allowed, fallback, doc) \
  {path, Form::form, unit, allowed, fallback, doc},
#include "scene/scene_schema.def"
#undef SCENE_KEY
  };
  return rows;
}

Allowed allowed_by(const SchemaRow& row) {
  Allowed allowed;
  std::istringstream in{std::string(row.allowed)};
  for (std::string word; in >> word;) {
    const bool bound = word[0] == '>';
    const std::size_t begin = bound ? (word[1] == '=' ? 2 : 1) : word.starts_with("count=") ? 6 : 0;
    if (begin == 0) {
      allowed.words.push_back(word);
      continue;
    }
    double number = 0;
    const auto read = std::from_chars(word.data() + begin, word.data() + word.size(), number);
    GMSIM_CHECK(read.ec == std::errc{}, "a bound of the scene schema is no number");
    if (bound)
      allowed.bound = number;
    else
      allowed.count = static_cast<std::size_t>(number);
    if (bound) allowed.strict = begin == 1;
  }
  return allowed;
}

const SchemaNode* SchemaNode::find(std::string_view key) const {
  for (const auto& [name, node] : keys)
    if (name == key) return node.get();
  return any_key.get();
}

std::vector<std::string> SchemaNode::key_names() const {
  std::vector<std::string> names;
  for (const auto& [name, node] : keys) names.push_back(name);
  return names;
}

std::string default_body_name(std::size_t body, std::size_t count) {
  return count == 1 ? "body" : "body" + std::to_string(body + 1);
}

const SchemaNode& schema() {
  static const SchemaNode root = build_tree();
  return root;
}

}  // namespace gmsim::scene
