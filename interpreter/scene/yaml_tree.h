// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "support/diagnostic.h"
#include "support/source_map.h"

namespace gmsim::scene {

struct YamlEntry;

/// A piece of YAML with its place. Unlike yaml-cpp's own tree it keeps the order of keys, knows
/// where values end, and has no key twice.
struct YamlNode {
  enum class Kind : std::uint8_t {
    Null,    ///< nothing after the colon, or `null`: as if the key were not there
    Scalar,  ///< `text`
    List,    ///< `items`
    Map      ///< `entries`
  };
  Kind kind = Kind::Null;
  std::string text;         ///< of a scalar, quotes and escapes resolved
  bool plain = true;        ///< a scalar without quotes
  bool is_default = false;  ///< filled in from the schema: its span is that of the mapping
  /// The scalar without its quotes; of a list or mapping from its first to its last byte.
  support::Span span;
  /// The bytes of `span` read like `text` but for white space.
  bool exact = true;
  std::vector<YamlNode> items;
  std::vector<YamlEntry> entries;

  [[nodiscard]] bool is_null() const { return kind == Kind::Null; }
  [[nodiscard]] bool is_scalar() const { return kind == Kind::Scalar; }
  [[nodiscard]] bool is_list() const { return kind == Kind::List; }
  [[nodiscard]] bool is_map() const { return kind == Kind::Map; }
  /// The value of a key of a mapping; null when it has none, or nothing stands there.
  [[nodiscard]] const YamlNode* find(std::string_view key) const;
  [[nodiscard]] YamlEntry* find_entry(std::string_view key);
  [[nodiscard]] const YamlEntry* find_entry(std::string_view key) const;

  static YamlNode scalar(std::string text, support::Span span);
};

struct YamlEntry {
  std::string key;
  support::Span key_span;
  YamlNode value;
};

/// Reads the bytes of `part` as one YAML document. Text that is no YAML, tabs in indentation, tags,
/// keys that are no words and duplicate keys are reported; the result is Null after a syntax error.
/// Aliases are replaced by what they stand for. Any text gives diagnostics or a tree.
[[nodiscard]] YamlNode parse_yaml(const support::SourceMap& sources, support::Span part,
                                  support::Diagnostics& diagnostics);

/// "a list", "a mapping", "nothing", or "`text`", for messages.
[[nodiscard]] std::string describe(const YamlNode& node);

/// The same values in the same places of the tree, whatever their spans.
[[nodiscard]] bool same_values(const YamlNode& a, const YamlNode& b);

}  // namespace gmsim::scene
