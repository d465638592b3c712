// SPDX-License-Identifier: MIT
#include "types/value.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>

#include "support/check.h"

namespace gmsim::types {
namespace {

/// Calls `print(i)` for i in [0, count) with commas between.
template <typename Print>
std::string list(std::string_view open, std::size_t count, std::string_view close, Print print) {
  std::string text(open);
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) text += ", ";
    text += print(i);
  }
  return text + std::string(close);
}

std::string tuple(std::span<const double> components) {
  return list("(", components.size(), ")",
              [&](std::size_t i) { return number_text(components[i]); });
}

std::string rows(std::span<const double> entries, std::size_t columns) {
  return list("(", entries.size() / columns, ")",
              [&](std::size_t i) { return tuple(entries.subspan(i * columns, columns)); });
}

std::string darts(const std::vector<DartId>& all) {
  return list("{", all.size(), "}", [&](std::size_t i) { return std::to_string(index(all[i])); });
}

std::string forces(std::span<const double> all) {
  return list("{", all.size() / 3, "}",
              [&](std::size_t i) { return tuple(all.subspan(i * 3, 3)); });
}

std::string storable_text(const ValueType& type, std::span<const double> data) {
  GMSIM_CHECK(data.size() == component_count(type), "a value lacks components");
  if (type.is_array()) {
    const ValueType element = type.element();
    const std::uint32_t size = component_count(element);
    return list("[", type.extents.front(), "]", [&](std::size_t i) {
      return storable_text(element, data.subspan(i * size, size));
    });
  }
  switch (type.kind) {
    case ValueKind::Bool:
      return data[0] != 0.0 ? "true" : "false";
    case ValueKind::Mat2:
      return rows(data, 2);
    case ValueKind::Mat3:
      return rows(data, 3);
    case ValueKind::Int:
    case ValueKind::Real:
      return number_text(data[0]);
    default:
      return tuple(data);
  }
}

}  // namespace

Value Value::boolean(bool b) {
  return {{ValueKind::Bool}, {b ? 1.0 : 0.0}};
}
Value Value::integer(std::int64_t i) {
  return {{ValueKind::Int}, {static_cast<double>(i)}};
}
Value Value::real(double x) {
  return {{ValueKind::Real}, {x}};
}
Value Value::vec3(double x, double y, double z) {
  return {{ValueKind::Vec3}, {x, y, z}};
}
Value Value::of_dart(DartId d) {
  return {{ValueKind::Dart}, {}, d};
}

Value Value::zero(const ValueType& type) {
  return {type, std::vector<double>(component_count(type), 0.0)};
}

bool Value::finite() const {
  return std::all_of(data.begin(), data.end(), [](double x) { return std::isfinite(x); });
}

std::string number_text(double x) {
  if (std::isnan(x)) return "nan";  // the sign of a NaN depends on the processor
  std::array<char, 32> buffer;
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x);
  return {buffer.data(), result.ptr};
}

std::string to_string(const Value& value) {
  if (is_storable(value.type)) return storable_text(value.type, value.data);
  const std::span<const double> data = value.data;
  switch (value.type.kind) {
    case ValueKind::Dart:
      return value.dart == kNoDart ? "no dart" : "dart " + std::to_string(index(value.dart));
    case ValueKind::Darts:
      return darts(value.darts);
    case ValueKind::Forces:
      return forces(data);
    case ValueKind::Range:
      return number_text(data[0]) + ".." + number_text(data[1]);
    case ValueKind::EigenPair:
      return "{ value " + number_text(data[0]) + ", vector " + tuple(data.subspan(1, 3)) + " }";
    default:
      return to_string(value.type);
  }
}

}  // namespace gmsim::types
