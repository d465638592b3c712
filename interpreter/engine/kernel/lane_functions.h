// SPDX-License-Identifier: MIT
#pragma once

/// Functions of single numbers that the operations of all instruction sets call, each compiled
/// once.
namespace gmsim::engine {

/// x = quadrant pi/2 + y + rest up to multiples of 2 pi, |y| <= pi/4.
struct QuadrantReduction {
  double quadrant = 0;
  double y = 0, rest = 0;
};
/// For |x| >= 2^20, with as many digits of 2/pi as x needs (Payne & Hanek 1983); not a number for
/// arguments that are not finite.
[[nodiscard]] QuadrantReduction reduce_large_angle(double x);

/// Remainder with the sign of the divisor.
[[nodiscard]] double modulo(double x, double divisor);

/// x^y for x > 0 by logarithm and exponential in twice the precision; other x by the rules of the C
/// library.
[[nodiscard]] double general_power(double x, double y);

/// The rotation closest to F for any F, by one-sided Jacobi rotations; see polar_rotation3, which
/// does ordinary matrices faster.
void polar_by_singular_values(const double* f, double* r);

/// The functions of engine/kernel/vector_math.h for one number: the same bits.
namespace fixed_order {
[[nodiscard]] double exp(double x);
[[nodiscard]] double log(double x);
[[nodiscard]] double sin(double x);
[[nodiscard]] double cos(double x);
[[nodiscard]] double tan(double x);
[[nodiscard]] double asin(double x);
[[nodiscard]] double acos(double x);
[[nodiscard]] double atan(double x);
[[nodiscard]] double atan2(double y, double x);
[[nodiscard]] double tanh(double x);
}  // namespace fixed_order

}  // namespace gmsim::engine
