// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "types/unit.h"

/// The keys of a scene: the rows of scene_schema.def, as a list and as a tree.
namespace gmsim::scene {

/// The form that a value has in YAML.
enum class Form : std::uint8_t {
  Section,    ///< a mapping with the keys that have rows
  Named,      ///< a mapping whose keys are names
  List,       ///< a list of mappings
  FieldList,  ///< a list of words or mappings
  Text,
  Choice,  ///< one of the allowed words
  Boolean,
  Integer,
  Number,  ///< with a unit or without; also an allowed word
  NumberOrSection,
  Expression,  ///< of the rule language
  Value,       ///< a number, an expression, or a list of components
  TextList,
  IntegerList,
  NumberList,
  IntegerTable,
  NumberTable  ///< lists of lists
};
/// "a number", "a list of whole numbers", for messages and documentation.
[[nodiscard]] std::string_view describe(Form form);

struct SchemaRow {
  std::string_view path;
  Form form;
  std::string_view unit;  ///< "" none, "*" whatever is meant
  std::string_view allowed;
  std::string_view fallback;
  std::string_view doc;

  [[nodiscard]] bool required() const { return fallback == "required"; }
};
[[nodiscard]] const std::vector<SchemaRow>& schema_rows();

/// `allowed` taken apart.
struct Allowed {
  std::vector<std::string> words;
  std::optional<double> bound;  ///< of numbers
  bool strict = false;          ///< above the bound, not at it
  std::size_t count = 0;        ///< entries of a list; 0: any number
};
[[nodiscard]] Allowed allowed_by(const SchemaRow& row);

/// A row and those below it.
struct SchemaNode {
  const SchemaRow* row = nullptr;  ///< null at the root and for entries of lists without a row
  Allowed allowed;
  types::MaybeUnit unit;  ///< empty: whatever is meant
  std::vector<std::pair<std::string, std::unique_ptr<SchemaNode>>> keys;
  std::unique_ptr<SchemaNode> any_key;  ///< `*`
  std::unique_ptr<SchemaNode> entry;    ///< `[]`

  [[nodiscard]] const SchemaNode* find(std::string_view key) const;
  [[nodiscard]] std::vector<std::string> key_names() const;
};
[[nodiscard]] const SchemaNode& schema();

/// The name of a body that a scene does not name: `body`, or `body1`, `body2` … of several.
[[nodiscard]] std::string default_body_name(std::size_t body, std::size_t count);

}  // namespace gmsim::scene
