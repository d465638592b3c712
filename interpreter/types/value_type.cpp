// SPDX-License-Identifier: MIT
#include "types/value_type.h"

#include <algorithm>
#include <array>

#include "support/check.h"

namespace gmsim::types {
namespace {

/// A storable kind: what users call it and how many doubles hold one.
struct StorableKind {
  ValueKind kind;
  std::string_view name;
  std::uint32_t components;
};
constexpr std::array<StorableKind, 8> kStorableKinds = {{{ValueKind::Bool, "bool", 1},
                                                         {ValueKind::Int, "int", 1},
                                                         {ValueKind::Real, "real", 1},
                                                         {ValueKind::Vec2, "vec2", 2},
                                                         {ValueKind::Vec3, "vec3", 3},
                                                         {ValueKind::Mat2, "mat2", 4},
                                                         {ValueKind::Mat3, "mat3", 9},
                                                         {ValueKind::Sym3, "sym3", 6}}};

const StorableKind* find_storable(ValueKind kind) {
  const auto found = std::find_if(kStorableKinds.begin(), kStorableKinds.end(),
                                  [&](const StorableKind& row) { return row.kind == kind; });
  return found == kStorableKinds.end() ? nullptr : &*found;
}

std::string_view name_of(ValueKind kind) {
  switch (kind) {
    case ValueKind::Bool:
    case ValueKind::Int:
    case ValueKind::Real:
    case ValueKind::Vec2:
    case ValueKind::Vec3:
    case ValueKind::Mat2:
    case ValueKind::Mat3:
    case ValueKind::Sym3:
      return find_storable(kind)->name;
    case ValueKind::Dart:
      return "dart";
    case ValueKind::Darts:
      return "darts";
    case ValueKind::Forces:
      return "forces";
    case ValueKind::Range:
      return "range";
    case ValueKind::EigenPair:
      return "eigenpair";
    case ValueKind::Orbit:
      return "orbit";
    case ValueKind::Zero:
      return "0";
    case ValueKind::Error:
      return "error";
  }
  return {};
}

}  // namespace

ValueType ValueType::element() const {
  GMSIM_CHECK(is_array(), "only an array has elements");
  return {kind, {extents.begin() + 1, extents.end()}};
}

std::uint32_t component_count(const ValueType& type) {
  const StorableKind* storable = find_storable(type.kind);
  GMSIM_CHECK(storable != nullptr, "no storable type: " + to_string(type));
  std::uint32_t count = storable->components;
  for (std::uint32_t extent : type.extents) count *= extent;
  return count;
}

std::uint32_t number_count(const ValueType& type) {
  switch (type.kind) {
    case ValueKind::EigenPair:
      return 4;
    case ValueKind::Range:
      return 2;
    case ValueKind::Zero:
      return 1;
    case ValueKind::Forces:
      return 0;
    default:
      return component_count(type);
  }
}

bool is_storable(const ValueType& type) {
  return find_storable(type.kind) != nullptr;
}

std::string to_string(const ValueType& type) {
  std::string text(name_of(type.kind));
  for (std::uint32_t extent : type.extents) text += "[" + std::to_string(extent) + "]";
  return text;
}

std::optional<ValueKind> value_kind(std::string_view name) {
  for (const StorableKind& row : kStorableKinds)
    if (row.name == name) return row.kind;
  return std::nullopt;
}

std::vector<std::string> value_type_names() {
  std::vector<std::string> names;
  for (const StorableKind& row : kStorableKinds) names.emplace_back(row.name);
  return names;
}

}  // namespace gmsim::types
