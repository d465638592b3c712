// SPDX-License-Identifier: MIT
#include "scene/resolved_text.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace gmsim::scene {
namespace {

/// Can the text stand without quotes anywhere, in brackets too?
bool safe_plain(const std::string& text) {
  static constexpr std::string_view kSafe = "_-+.*/()<>=^";
  const auto safe = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           kSafe.find(c) != std::string_view::npos;
  };
  static constexpr std::string_view kFirst = "_.(/+";
  const bool first = !text.empty() && (std::isalnum(static_cast<unsigned char>(text[0])) != 0 ||
                                       kFirst.find(text[0]) != std::string_view::npos ||
                                       (text[0] == '-' && text.size() > 1 && text[1] != ' '));
  const bool null = text == "null" || text == "Null" || text == "NULL";
  return first && !null && text != "---" && text != "..." && text.back() != ' ' &&
         std::ranges::all_of(text, [&](char c) { return safe(c) || c == ' '; });
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\n')
      result += "\\n";
    else if (c == '\t')
      result += "\\t";
    else if (c == '\r')
      result += "\\r";
    else
      result += c;
  }
  return result + "\"";
}

std::string scalar_text(const std::string& text, bool plain) {
  return plain && safe_plain(text) ? text : quoted(text);
}

/// Lists of words and numbers, and lists of such lists, stand in brackets; so do empty things.
bool in_one_line(const YamlNode& node) {
  if (node.is_map()) return node.entries.empty();
  return std::ranges::all_of(node.items, in_one_line);
}

std::string one_line(const YamlNode& node) {
  if (node.is_scalar()) return scalar_text(node.text, node.plain);
  if (node.is_map()) return "{}";
  std::string result = "[";
  for (std::size_t i = 0; i < node.items.size(); ++i)
    result += (i > 0 ? ", " : "") + one_line(node.items[i]);
  return result + "]";
}

void write(const YamlNode& node, std::size_t indent, std::string& out);

void write_behind(const YamlNode& node, std::size_t indent, std::string& out) {
  if (in_one_line(node)) {
    out += " " + one_line(node) + "\n";
  } else {
    out += "\n";
    write(node, indent, out);
  }
}

void write(const YamlNode& node, std::size_t indent, std::string& out) {
  for (const YamlEntry& entry : node.entries) {
    out += std::string(indent, ' ') + scalar_text(entry.key, true) + ":";
    write_behind(entry.value, indent + 2, out);
  }
  for (const YamlNode& item : node.items) {
    out += std::string(indent, ' ') + "-";
    if (!item.is_map() || item.entries.empty()) {
      write_behind(item, indent + 2, out);
      continue;
    }
    std::string block;
    write(item, indent + 2, block);
    out += " " + block.substr(indent + 2);
  }
}

}  // namespace

std::string resolved_text(const YamlNode& scene) {
  std::string out;
  write(scene, 0, out);
  return out;
}

}  // namespace gmsim::scene
