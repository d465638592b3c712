// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/yaml_tree.h"
#include "support/diagnostic.h"
#include "support/source_map.h"
#include "types/expr.h"

namespace gmsim::scene {

/// A text of the rule language that was put together from pieces of a scene, and the way back:
/// every place in it is a place in the scene, so messages and expressions point into the YAML.
class MappedText {
 public:
  /// A value of the scene as an expression: `60 N/m` becomes `60 [N/m]`, a list a tuple. Nothing in
  /// a node of another form is read.
  static MappedText of_value(const support::SourceMap& sources, const YamlNode& node);
  /// The bytes of a span as they are.
  static MappedText of_span(const support::SourceMap& sources, support::Span span);

  [[nodiscard]] const std::string& text() const { return text_; }
  /// Makes it a text of its own.
  support::FileId add_to(support::SourceMap& sources, std::string name);

  [[nodiscard]] support::Span map(support::Span span) const;
  [[nodiscard]] support::Diagnostic map(support::Diagnostic diagnostic) const;
  /// The same expression with spans in the scene; shared parts stay shared.
  [[nodiscard]] types::ExprPtr map(const types::ExprPtr& expr) const;
  /// Reports all of `found` in the scene's words.
  void report(const support::Diagnostics& found, support::Diagnostics& diagnostics) const;

 private:
  struct Piece {
    std::uint32_t begin = 0;
    support::Span source;
    bool exact = false;  ///< byte for byte
  };
  void append(std::string_view text, support::Span source, bool exact);
  void append_scalar(const support::SourceMap& sources, const YamlNode& node);
  [[nodiscard]] std::uint32_t place(std::uint32_t offset, bool end) const;

  std::string text_;
  std::vector<Piece> pieces_;
  support::FileId file_{};
};

/// A number at the beginning of a scalar and what stands behind it, `60` and `N/m`.
struct NumberAndUnit {
  std::string_view number;
  std::string_view unit;       ///< empty when there is none
  std::size_t unit_begin = 0;  ///< in the text
};
/// Empty when the text is something else, an expression say.
[[nodiscard]] std::optional<NumberAndUnit> split_quantity(std::string_view text);

}  // namespace gmsim::scene
