// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gmsim::types {

/// A physical dimension as exponents of m, kg, s, A, K, mol, each in twelfths so that roots of a
/// unit are exact. Angles (rad) are dimensionless. Values are always held in SI.
struct Unit {
  static constexpr int kBases = 6;
  static constexpr int kDenominator = 12;
  std::array<std::int16_t, kBases> exponents{};

  bool operator==(const Unit&) const = default;
  [[nodiscard]] bool dimensionless() const { return *this == Unit{}; }
};

/// A named unit: its dimension and how many SI units it is (`mm`: metres, 1e-3).
struct NamedUnit {
  Unit unit;
  double scale = 1.0;
};

/// Gradual typing of units: empty means "not known", which agrees with every unit.
using MaybeUnit = std::optional<Unit>;

[[nodiscard]] Unit operator*(const Unit& a, const Unit& b);
[[nodiscard]] Unit operator/(const Unit& a, const Unit& b);
/// unit^(numerator/denominator); empty when the result is no multiple of a twelfth.
[[nodiscard]] std::optional<Unit> power(const Unit& unit, int numerator, int denominator = 1);
/// SI units with the usual prefixes: m, mm, kg, g, s, ms, N, kN, Pa, MPa, J, Hz, rad, deg, "1" …
[[nodiscard]] std::optional<NamedUnit> named_unit(std::string_view name);
[[nodiscard]] std::vector<std::string> unit_names();
/// "kg m/s^2"; well-known combinations print by name ("N", "N/m", "Pa", "J"); "1" if dimensionless.
[[nodiscard]] std::string to_string(const Unit& unit);

}  // namespace gmsim::types
