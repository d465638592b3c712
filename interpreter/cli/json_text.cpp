// SPDX-License-Identifier: MIT
#include "cli/json_text.h"

#include <fmt/format.h>

#include <cmath>

namespace gmsim::cli {

std::string json(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "null";
}

std::string json(bool value) {
  return value ? "true" : "false";
}

std::string json(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    switch (c) {
      case '"': result += "\\\""; break;
      case '\\': result += "\\\\"; break;
      case '\n': result += "\\n"; break;
      case '\t': result += "\\t"; break;
      default:
        if (static_cast<unsigned char>(c) < 0x20) result += fmt::format("\\u{:04x}", c);
        else result += c;
    }
  }
  return result + "\"";
}

std::string json(std::span<const double> values) {
  JsonArray array;
  for (const double value : values) array.add_text(json(value));
  return array.text();
}

JsonObject& JsonObject::add_text(std::string_view name, std::string_view text) {
  if (!members_.empty()) members_ += ", ";
  members_ += json(name) + ": ";
  members_ += text;
  return *this;
}

JsonArray& JsonArray::add_text(std::string_view text) {
  if (!values_.empty()) values_ += ", ";
  values_ += text;
  return *this;
}

}  // namespace gmsim::cli
