// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gmsim::types {

/// The kinds of value an expression can have.
enum class ValueKind : std::uint8_t {
  Bool, Int, Real, Vec2, Vec3, Mat2, Mat3, Sym3,
  Dart,       ///< a dart of the map
  Darts,      ///< a collection of darts
  Forces,     ///< a collection of atomic forces (vec3), from forces(orbit)
  Range,      ///< lo..hi, half open
  EigenPair,  ///< { value : real, vector : vec3 }
  Orbit,      ///< the name of an orbit type, as in `vertex(a) / corner`
  Zero,       ///< the literal 0: the zero of every type
  Error       ///< an expression that was reported already; compatible with everything
};

/// A kind with array extents: `vec3[4][8]` is {Vec3, {4, 8}}.
struct ValueType {
  ValueKind kind = ValueKind::Error;
  std::vector<std::uint32_t> extents = {};

  bool operator==(const ValueType&) const = default;
  [[nodiscard]] bool is_array() const { return !extents.empty(); }
  /// Type of one element of an array.
  [[nodiscard]] ValueType element() const;
};

/// Number of doubles that hold a value of a storable type (Bool … Sym3 and arrays of them).
/// Matrices are row-major; Sym3 is stored xx, yy, zz, yz, xz, xy.
[[nodiscard]] std::uint32_t component_count(const ValueType& type);
/// Doubles of a value of any type while expressions are evaluated: also of an eigenpair (4), a range
/// (2), the literal 0 (1) and a collection of forces (0).
[[nodiscard]] std::uint32_t number_count(const ValueType& type);
/// One double: bool, int, real or the literal 0.
[[nodiscard]] inline bool is_scalar(const ValueType& type) {
  return (type.kind <= ValueKind::Real || type.kind == ValueKind::Zero) && !type.is_array();
}
/// Bool, Int, Real, Vec*, Mat*, Sym3, and arrays of them: what an embedding or parameter can be.
[[nodiscard]] bool is_storable(const ValueType& type);
[[nodiscard]] std::string to_string(const ValueType& type);
/// "vec3" -> Vec3; empty when no storable type has this name.
[[nodiscard]] std::optional<ValueKind> value_kind(std::string_view name);
/// The names a user can write, for suggestions.
[[nodiscard]] std::vector<std::string> value_type_names();

}  // namespace gmsim::types
