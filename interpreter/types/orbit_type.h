// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <compare>
#include <cstdint>
#include <initializer_list>
#include <string>

namespace gmsim::types {

/// A dart of a generalized map. Ids are never reused within a run, so files may refer to them.
enum class DartId : std::uint32_t {};
inline constexpr DartId kNoDart{0xffffffffu};
[[nodiscard]] constexpr std::uint32_t index(DartId dart) { return static_cast<std::uint32_t>(dart); }

/// Highest dimension of a map.
inline constexpr int kMaxDimension = 3;

/// A set of link dimensions, written <0,2>; the orbit of a dart is what these links reach.
/// (Theory 1.2; CGAL, "Generalized maps", orbits.) The empty set <> is a single dart.
class OrbitType {
 public:
  constexpr OrbitType() = default;
  constexpr OrbitType(std::initializer_list<int> dimensions) {
    for (int i : dimensions) insert(i);
  }
  static constexpr OrbitType from_bits(std::uint8_t bits) {
    OrbitType type;
    type.bits_ = bits;
    return type;
  }
  /// <first..last>, empty when first > last.
  static constexpr OrbitType range(int first, int last) {
    OrbitType type;
    for (int i = first; i <= last; ++i) type.insert(i);
    return type;
  }
  /// The orbit of the i-cell in a map of dimension n: every link but i.
  static constexpr OrbitType cell(int i, int n) {
    OrbitType type = range(0, n);
    type.bits_ = static_cast<std::uint8_t>(type.bits_ & ~(1u << i));
    return type;
  }

  constexpr void insert(int i) { bits_ = static_cast<std::uint8_t>(bits_ | (1u << i)); }
  [[nodiscard]] constexpr bool contains(int i) const { return ((bits_ >> i) & 1u) != 0; }
  [[nodiscard]] constexpr bool contains(OrbitType other) const {
    return (bits_ & other.bits_) == other.bits_;
  }
  [[nodiscard]] constexpr bool meets(OrbitType other) const { return (bits_ & other.bits_) != 0; }
  [[nodiscard]] constexpr bool empty() const { return bits_ == 0; }
  [[nodiscard]] constexpr std::uint8_t bits() const { return bits_; }
  /// Exactly one link.
  [[nodiscard]] constexpr bool is_single() const {
    return bits_ != 0 && (bits_ & (bits_ - 1)) == 0;  // std::has_single_bit is a call without SSE4
  }
  /// The lowest link; the type must not be empty.
  [[nodiscard]] constexpr int first() const { return std::countr_zero(bits_); }
  constexpr auto operator<=>(const OrbitType&) const = default;

 private:
  std::uint8_t bits_ = 0;
};

/// "<0,2>", as everywhere in messages and in the paper.
[[nodiscard]] std::string to_string(OrbitType type);

}  // namespace gmsim::types
