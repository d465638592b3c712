// SPDX-License-Identifier: MIT
#include "types/unit.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <numbers>

#include "support/check.h"

namespace gmsim::types {
namespace {

constexpr std::array<std::string_view, Unit::kBases> kBaseNames = {"m", "kg", "s", "A", "K", "mol"};
/// Order in which the bases are printed: mass before length, as in kg m/s^2.
constexpr std::array<std::size_t, Unit::kBases> kPrintOrder = {1, 0, 2, 3, 4, 5};

struct Prefix {
  char letter;
  int power_of_ten;
};
constexpr std::array<Prefix, 8> kPrefixes = {
    {{'n', -9}, {'u', -6}, {'m', -3}, {'c', -2}, {'d', -1}, {'k', 3}, {'M', 6}, {'G', 9}}};

/// A unit without prefix: whole exponents of m, kg, s, A, K, mol; `factor` times
/// 10^`power_of_ten` SI units; and the prefixes that it takes.
struct UnitRow {
  std::string_view name;
  std::array<int, Unit::kBases> exponents;
  double factor;
  int power_of_ten;
  std::string_view prefixes;
};
constexpr std::array<UnitRow, 21> kUnits = {{
    {"1", {}, 1, 0, ""},
    {"m", {1}, 1, 0, "numcdk"},
    {"g", {0, 1}, 1, -3, "umk"},
    {"t", {0, 1}, 1, 3, ""},
    {"s", {0, 0, 1}, 1, 0, "num"},
    {"min", {0, 0, 1}, 60, 0, ""},
    {"h", {0, 0, 1}, 3600, 0, ""},
    {"A", {0, 0, 0, 1}, 1, 0, "m"},
    {"K", {0, 0, 0, 0, 1}, 1, 0, "m"},
    {"mol", {0, 0, 0, 0, 0, 1}, 1, 0, "m"},
    {"rad", {}, 1, 0, "m"},
    {"deg", {}, std::numbers::pi / 180, 0, ""},
    {"N", {1, 1, -2}, 1, 0, "numckMG"},
    {"Pa", {-1, 1, -2}, 1, 0, "mkMG"},
    {"J", {2, 1, -2}, 1, 0, "numkM"},
    {"W", {2, 1, -3}, 1, 0, "umkM"},
    {"Hz", {0, 0, -1}, 1, 0, "mkMG"},
    {"L", {3}, 1, -3, "umcd"},
    {"C", {0, 0, 1, 1}, 1, 0, "num"},
    {"V", {2, 1, -3, -1}, 1, 0, "mk"},
    {"bar", {-1, 1, -2}, 1, 5, "m"},
}};

/// Combinations that people call by these names rather than by their bases.
struct KnownUnit {
  std::string_view name;
  std::array<int, Unit::kBases> exponents;
};
constexpr std::array<KnownUnit, 7> kKnownUnits = {{{"N", {1, 1, -2}},
                                                   {"N/m", {0, 1, -2}},
                                                   {"N s/m", {0, 1, -1}},
                                                   {"Pa", {-1, 1, -2}},
                                                   {"Pa s", {-1, 1, -1}},
                                                   {"J", {2, 1, -2}},
                                                   {"W", {2, 1, -3}}}};

Unit unit_of(const std::array<int, Unit::kBases>& whole) {
  Unit unit;
  for (std::size_t i = 0; i < whole.size(); ++i)
    unit.exponents[i] = static_cast<std::int16_t>(whole[i] * Unit::kDenominator);
  return unit;
}

constexpr int kLargest = std::numeric_limits<std::int16_t>::max();

std::int16_t saturated(int exponent) {
  return static_cast<std::int16_t>(std::clamp(exponent, -kLargest, kLargest));
}

/// 10^exponent, correctly rounded (a product of powers would not be).
double power_of_ten(int exponent) {
  const std::string text = "1e" + std::to_string(exponent);
  double value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  GMSIM_CHECK(result.ec == std::errc{}, "power of ten out of range");
  return value;
}

NamedUnit with_prefix(const UnitRow& row, int prefix_power) {
  return {unit_of(row.exponents), row.factor * power_of_ten(row.power_of_ten + prefix_power)};
}

/// "m", "m^2", "m^(1/2)" for a positive number of twelfths.
std::string base_power(std::size_t base, int twelfths) {
  const std::string name(kBaseNames[base]);
  if (twelfths == Unit::kDenominator) return name;
  if (twelfths % Unit::kDenominator == 0)
    return name + "^" + std::to_string(twelfths / Unit::kDenominator);
  int divisor = Unit::kDenominator;
  while (twelfths % divisor != 0 || Unit::kDenominator % divisor != 0) --divisor;
  return name + "^(" + std::to_string(twelfths / divisor) + "/" +
         std::to_string(Unit::kDenominator / divisor) + ")";
}

std::string joined(const std::vector<std::string>& factors) {
  std::string text;
  for (const std::string& factor : factors) text += (text.empty() ? "" : " ") + factor;
  return text;
}

}  // namespace

Unit operator*(const Unit& a, const Unit& b) {
  Unit product;
  for (std::size_t i = 0; i < a.exponents.size(); ++i)
    product.exponents[i] = saturated(a.exponents[i] + b.exponents[i]);
  return product;
}

Unit operator/(const Unit& a, const Unit& b) {
  Unit quotient;
  for (std::size_t i = 0; i < a.exponents.size(); ++i)
    quotient.exponents[i] = saturated(a.exponents[i] - b.exponents[i]);
  return quotient;
}

std::optional<Unit> power(const Unit& unit, int numerator, int denominator) {
  if (denominator == 0) return std::nullopt;
  Unit result;
  for (std::size_t i = 0; i < unit.exponents.size(); ++i) {
    const std::int64_t scaled = std::int64_t{unit.exponents[i]} * numerator;
    if (scaled % denominator != 0) return std::nullopt;
    const std::int64_t exponent = scaled / denominator;
    if (exponent > kLargest || exponent < -kLargest) return std::nullopt;
    result.exponents[i] = static_cast<std::int16_t>(exponent);
  }
  return result;
}

std::optional<NamedUnit> named_unit(std::string_view name) {
  for (const UnitRow& row : kUnits)
    if (row.name == name) return with_prefix(row, 0);
  for (const UnitRow& row : kUnits)
    for (const Prefix& prefix : kPrefixes)
      if (row.prefixes.find(prefix.letter) != std::string_view::npos &&
          name.size() == row.name.size() + 1 && name[0] == prefix.letter &&
          name.ends_with(row.name))
        return with_prefix(row, prefix.power_of_ten);
  return std::nullopt;
}

std::vector<std::string> unit_names() {
  std::vector<std::string> names;
  for (const UnitRow& row : kUnits) {
    names.emplace_back(row.name);
    for (char prefix : row.prefixes) names.push_back(prefix + std::string(row.name));
  }
  return names;
}

std::string to_string(const Unit& unit) {
  for (const KnownUnit& known : kKnownUnits)
    if (unit_of(known.exponents) == unit) return std::string(known.name);
  std::vector<std::string> over;
  std::vector<std::string> under;
  for (std::size_t base : kPrintOrder) {
    const int twelfths = unit.exponents[base];
    if (twelfths > 0) over.push_back(base_power(base, twelfths));
    if (twelfths < 0) under.push_back(base_power(base, -twelfths));
  }
  const std::string top = over.empty() ? "1" : joined(over);
  if (under.empty()) return top;
  return under.size() == 1 ? top + "/" + under.front() : top + "/(" + joined(under) + ")";
}

}  // namespace gmsim::types
