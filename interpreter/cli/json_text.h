// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <span>
#include <string>
#include <string_view>

namespace gmsim::cli {

/// Values as JSON text. Numbers keep all their digits; what is not finite becomes null.
[[nodiscard]] std::string json(double value);
[[nodiscard]] std::string json(bool value);
[[nodiscard]] std::string json(std::string_view text);
[[nodiscard]] std::string json(std::span<const double> values);
template <std::integral Integer>
[[nodiscard]] std::string json(Integer value) {
  return std::to_string(value);
}
[[nodiscard]] inline std::string json(const char* text) { return json(std::string_view(text)); }
[[nodiscard]] inline std::string json(const std::string& text) {
  return json(std::string_view(text));
}

/// An object that is written from the first member to the last.
class JsonObject {
 public:
  template <class Value>
  JsonObject& add(std::string_view name, const Value& value) {
    return add_text(name, json(value));
  }
  /// `text` is JSON already.
  JsonObject& add_text(std::string_view name, std::string_view text);
  [[nodiscard]] std::string text() const { return "{" + members_ + "}"; }

 private:
  std::string members_;
};

/// An array of values that are JSON already.
class JsonArray {
 public:
  JsonArray& add_text(std::string_view text);
  [[nodiscard]] std::string text() const { return "[" + values_ + "]"; }

 private:
  std::string values_;
};

}  // namespace gmsim::cli
