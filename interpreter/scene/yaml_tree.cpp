// SPDX-License-Identifier: MIT
#include "scene/yaml_tree.h"

#include <algorithm>

namespace gmsim::scene {

const YamlEntry* YamlNode::find_entry(std::string_view key) const {
  const auto found = std::ranges::find(entries, key, &YamlEntry::key);
  return found == entries.end() ? nullptr : &*found;
}

YamlEntry* YamlNode::find_entry(std::string_view key) {
  const auto found = std::ranges::find(entries, key, &YamlEntry::key);
  return found == entries.end() ? nullptr : &*found;
}

const YamlNode* YamlNode::find(std::string_view key) const {
  const YamlEntry* entry = find_entry(key);
  return entry == nullptr || entry->value.is_null() ? nullptr : &entry->value;
}

YamlNode YamlNode::scalar(std::string text, support::Span span) {
  YamlNode node;
  node.kind = Kind::Scalar;
  node.text = std::move(text);
  node.span = span;
  return node;
}

std::string describe(const YamlNode& node) {
  constexpr std::size_t kLongest = 40;
  switch (node.kind) {
    case YamlNode::Kind::Null:
      return "nothing";
    case YamlNode::Kind::List:
      return "a list";
    case YamlNode::Kind::Map:
      return "a mapping";
    case YamlNode::Kind::Scalar:
      break;
  }
  std::string text = "`" + node.text.substr(0, node.text.find('\n')) + "`";
  if (text.size() <= kLongest) return text;
  std::size_t end = kLongest;
  while (end > 1 && (static_cast<unsigned char>(text[end]) & 0xC0u) == 0x80u)
    --end;  // whole letters
  return text.substr(0, end) + "…`";
}

bool same_values(const YamlNode& a, const YamlNode& b) {
  const auto same_entry = [](const YamlEntry& x, const YamlEntry& y) {
    return x.key == y.key && same_values(x.value, y.value);
  };
  return a.kind == b.kind && a.text == b.text &&
         std::ranges::equal(a.items, b.items, same_values) &&
         std::ranges::equal(a.entries, b.entries, same_entry);
}

}  // namespace gmsim::scene
