// SPDX-License-Identifier: MIT
#include "engine/kernel/lane_functions.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "engine/builtins.h"
#include "engine/kernel/block_frame.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#define GMSIM_VECTOR_BYTES 16

namespace gmsim::engine {
namespace {
namespace lanes {
#include "engine/kernel/vector.h"
#include "engine/kernel/vector_math.h"
// In this order: both need vector.h.
#include "engine/kernel/vector_polar.h"
}  // namespace lanes

/// An unevaluated sum, the second below half a unit in the last place of the first.
struct Double2 {
  double high = 0, low = 0;
};
Double2 sum(double a, double b) {
  const double s = a + b, part = s - a;
  return {s, (a - (s - part)) + (b - part)};
}
/// Dekker 1971: products of halves are exact.
Double2 product(double a, double b) {
  const auto head = [](double x) {
    const double big = x * 134217729.0;
    return big - (big - x);
  };
  const double p = a * b, ah = head(a), bh = head(b), al = a - ah, bl = b - bh;
  return {p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}
Double2 add(Double2 a, Double2 b) {
  const Double2 s = sum(a.high, b.high);
  return sum(s.high, s.low + (a.low + b.low));
}
Double2 multiply(Double2 a, Double2 b) {
  const Double2 p = product(a.high, b.high);
  return sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}
Double2 divide(Double2 a, Double2 b) {
  const double q = a.high / b.high;
  const Double2 back = multiply({q, 0}, b);
  const double rest = ((a.high - back.high) - back.low) + a.low;
  return sum(q, rest / b.high);
}

/// 2/pi after the binary point.
constexpr std::uint64_t kTwoOverPi[] = {
    0xa2f9836e4e441529, 0xfc2757d1f534ddc0, 0xdb6295993c439041, 0xfe5163abdebbc561,
    0xb7246e3a424dd2e0, 0x06492eea09d1921c, 0xfe1deb1cb129a73e, 0xe88235f52ebb4484,
    0xe99c7026b45f7e41, 0x3991d639835339f4, 0x9c845f8bbdf9283b, 0x1ff897ffde05980f,
    0xef2f118b5a0a6d1f, 0x6d367ecf27cb09b7, 0x4f463f669e5fea2d, 0x7527bac7ebe5f17b,
    0x3d0739f78a5292ea, 0x6bfb5fb11f8d5d08, 0x56033046fc7b6bab};

/// 64 digits of 2/pi after the first `skipped`; those before the point are zero.
std::uint64_t digits(int skipped) {
  const auto word = [](int k) { return k < 0 ? 0 : kTwoOverPi[k]; };
  const int first = skipped >= 0 ? skipped / 64 : -((63 - skipped) / 64),
            shift = skipped - 64 * first;
  const std::uint64_t high = word(first) << shift;
  return shift == 0 ? high : high | word(first + 1) >> (64 - shift);
}

__extension__ typedef unsigned __int128 Wide;

/// The logarithm of m in [sqrt(1/2), sqrt(2)): 2 atanh(s) with the first two terms doubled.
Double2 precise_log(double m) {
  const Double2 s = divide(sum(m, -1.0), sum(m, 1.0));
  const Double2 z = multiply(s, s);
  double tail = 0;
  for (int k = 31; k >= 5; k -= 2) tail = tail * z.high + 2.0 / k;
  const Double2 third = divide({2, 0}, {3, 0});
  const Double2 bend = multiply(multiply(s, z), add(third, {tail * z.high, 0}));
  return add({2 * s.high, 2 * s.low}, bend);
}

/// x^y for finite x > 0 and finite y.
double positive_power(double x, double y) {
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < 0x1.6a09e667f3bcdp-1) {
    m *= 2;
    --exponent;
  }
  const Double2 ln2 = {0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};
  const Double2 log_x = add(multiply(ln2, {static_cast<double>(exponent), 0}), precise_log(m));
  if (std::abs(y) > 0x1p64 || std::abs(log_x.high * y) > 800) {  // far out of range, or x = 1
    const double far = log_x.high == 0 ? 0 : (log_x.high > 0) == (y > 0) ? 1000.0 : -1000.0;
    return fixed_order::exp(far);
  }
  const Double2 e = multiply(log_x, {y, 0});
  const double value = fixed_order::exp(e.high);
  return std::isfinite(value) ? value + value * e.low : value;
}

}  // namespace

QuadrantReduction reduce_large_angle(double x) {
  if (!std::isfinite(x)) return {0, NAN, NAN};
  const auto bits = std::bit_cast<std::uint64_t>(std::abs(x));
  const std::uint64_t m = (bits & 0xfffffffffffff) | (std::uint64_t(1) << 52);
  const int exponent = static_cast<int>(bits >> 52) - 1075;  // |x| = m 2^exponent
  // 192 digits from the place where their product with |x| is below 4: a fixed-point number with
  // two digits before the point, the quadrant.
  const int skipped = exponent - 2;
  const Wide low = Wide(m) * digits(skipped + 128);
  const Wide middle = Wide(m) * digits(skipped + 64) + static_cast<std::uint64_t>(low >> 64);
  const std::uint64_t top = m * digits(skipped) + static_cast<std::uint64_t>(middle >> 64);
  const auto mid = static_cast<std::uint64_t>(middle), end = static_cast<std::uint64_t>(low);
  // The fraction, from -1/2 to 1/2.
  std::uint64_t w2 = top << 2 | mid >> 62, w1 = mid << 2 | end >> 62, w0 = end << 2;
  std::uint64_t quadrant = top >> 62;
  const bool negative = (w2 >> 63) != 0;
  if (negative) {
    ++quadrant;
    w0 = ~w0 + 1;
    w1 = ~w1 + (w0 == 0);
    w2 = ~w2 + (w0 == 0 && w1 == 0);
  }
  int zeros = 0;
  while ((w2 >> 63) == 0 && zeros < 190) {
    w2 = w2 << 1 | w1 >> 63;
    w1 = w1 << 1 | w0 >> 63;
    w0 <<= 1;
    ++zeros;
  }
  const Double2 fraction = {std::ldexp(static_cast<double>(w2 >> 11), -53 - zeros),
                            std::ldexp(static_cast<double>(w2 << 53 | w1 >> 11), -117 - zeros)};
  const Double2 y = multiply(fraction, {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54});
  const double sign = negative != std::signbit(x) ? -1.0 : 1.0;
  const auto turns = static_cast<double>(quadrant & 3);
  return {std::signbit(x) ? -turns : turns, sign * y.high, sign * y.low};
}

double modulo(double x, double divisor) {
  const double rest = std::fmod(x, divisor);
  return rest != 0.0 && (rest < 0.0) != (divisor < 0.0) ? rest + divisor : rest;
}

double general_power(double x, double y) {
  const bool ordinary = std::isfinite(x) && std::isfinite(y) && x != 0;
  if (!ordinary) return std::pow(x, y);  // exact cases: zeros, infinities, not numbers
  if (x > 0) return positive_power(x, y);
  if (y != std::floor(y)) return NAN;
  const bool odd = std::fmod(y, 2.0) != 0;
  return odd ? -positive_power(-x, y) : positive_power(-x, y);
}

void polar_rotation3(const double* f, double* r) {
  lanes::Pack<9> m;
  for (int k = 0; k < 9; ++k) m.c[k] = lanes::broadcast(f[k]);
  m = lanes::polar_rotation(m);
  for (int k = 0; k < 9; ++k) r[k] = m.c[k][0];
}

namespace fixed_order {
#define GMSIM_ONE_LANE(name)                    \
  double name(double x) {                       \
    return lanes::name(lanes::broadcast(x))[0]; \
  }
GMSIM_ONE_LANE(exp)
GMSIM_ONE_LANE(log)
GMSIM_ONE_LANE(sin)
GMSIM_ONE_LANE(cos)
GMSIM_ONE_LANE(tan)
GMSIM_ONE_LANE(asin)
GMSIM_ONE_LANE(acos)
GMSIM_ONE_LANE(atan)
GMSIM_ONE_LANE(tanh)
#undef GMSIM_ONE_LANE
double atan2(double y, double x) {
  return lanes::atan2(lanes::broadcast(y), lanes::broadcast(x))[0];
}
}  // namespace fixed_order

}  // namespace gmsim::engine
