// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace gmsim::compile {

/// Whole exponents up to this size are repeated multiplication, everywhere in the program.
inline constexpr double kLargestWholePower = 64;

[[nodiscard]] inline bool is_small_whole(double exponent) {
  return exponent == std::floor(exponent) && std::abs(exponent) <= kLargestWholePower;
}

/// x^exponent for a small whole exponent by squaring, from the lowest bit of the exponent up; for a
/// negative one the reciprocal of that.
template <typename Number>
[[nodiscard]] Number whole_power(Number x, double exponent) {
  Number result = 1;
  for (auto bits = static_cast<unsigned>(std::abs(exponent)); bits != 0; bits >>= 1u, x *= x)
    if ((bits & 1u) != 0) result *= x;
  return exponent < 0 ? 1 / result : result;
}

}  // namespace gmsim::compile
