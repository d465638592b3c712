// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "scene/schema.h"
#include "scene/yaml_tree.h"
#include "support/diagnostic.h"
#include "support/source_map.h"

namespace gmsim::scene {

/// Compares single values with their rows of the schema. Every function reports what is wrong and
/// says whether the value is good.
class ValueValidator {
 public:
  ValueValidator(support::SourceMap& sources, support::Diagnostics& diagnostics)
      : sources_(sources), diagnostics_(diagnostics) {}

  bool text(const YamlNode& node, const SchemaNode& schema);
  bool choice(const YamlNode& node, const SchemaNode& schema);
  bool boolean(const YamlNode& node, const SchemaNode& schema);
  bool integer(const YamlNode& node, const SchemaNode& schema);
  bool number(const YamlNode& node, const SchemaNode& schema);
  bool expression(const YamlNode& node, const SchemaNode& schema);
  /// A vector as a list.
  bool components(const YamlNode& node, const SchemaNode& schema);
  bool plain_list(const YamlNode& node, const SchemaNode& schema, Form form);
  bool table(const YamlNode& node, const SchemaNode& schema, Form form);

  /// Reports that something else is needed; false.
  bool wrong_form(const YamlNode& node, std::string_view wanted, const SchemaNode& schema);
  void report(support::DiagnosticKind kind, support::Span place, std::string message,
              std::string help = {});
  /// A place in one line reads better than a block.
  [[nodiscard]] support::Span first_line(support::Span span) const;

 private:
  bool refuse_boolean(const YamlNode& node);
  bool in_bounds(const YamlNode& node, double value, const Allowed& allowed, std::string_view unit);
  bool entry(const YamlNode& item, const SchemaNode& schema, Form form);

  support::SourceMap& sources_;
  support::Diagnostics& diagnostics_;
};

}  // namespace gmsim::scene
