// SPDX-License-Identifier: MIT
// Transcendental functions on vectors, in an order of operations that no machine changes: they
// replace the system's library, which picks code by processor. Errors stay below one unit in the
// last place, those of tan, asin and acos below 2.5, of the others below 1.5. Included after
// vector.h.
//
// Methods: reduction of the argument with constants split so that products are exact (Cody & Waite
// 1980), then Taylor series, or polynomials through Chebyshev points where those converge slowly.

/// c[0] + c[1] x + ... + c[N-1] x^(N-1)
template <std::size_t N>
GMSIM_INLINE V polynomial(const double (&c)[N], V x) {
  V sum = broadcast(c[N - 1]);
  for (std::size_t k = N - 1; k-- > 0;) sum = sum * x + c[k];
  return sum;
}

typedef unsigned long long Unsigned __attribute__((vector_size(GMSIM_VECTOR_BYTES)));

/// Whole numbers below 2^51 as integers, and back.
GMSIM_INLINE Bits to_integer(V whole) {
  return Bits(whole + 0x1.8p52) - Bits(broadcast(0x1.8p52));
}
GMSIM_INLINE V from_integer(Bits whole) {
  return V(whole + Bits(broadcast(0x1.8p52))) - 0x1.8p52;
}
/// 2^k for -1022 <= k <= 1023.
GMSIM_INLINE V power_of_two(V k) {
  return V((to_integer(k) + 1023) << 52);
}

constexpr double kLn2High =
    0x1.62e42fefa3000p-1;  // products with whole numbers up to 2^12 are exact
constexpr double kLn2Low = 0x1.3de6af278ece6p-42;

static V exp(V x) {
  static const double inverse_factorials[] = {
      1.0 / 2,     1.0 / 6,      1.0 / 24,      1.0 / 120,      1.0 / 720,       1.0 / 5040,
      1.0 / 40320, 1.0 / 362880, 1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800};
  x = select(x > 710.0, broadcast(710.0), select(x < -746.0, broadcast(-746.0), x));
  const V k = nearest(x * 0x1.71547652b82fep+0);  // 1 / ln 2
  const V high = x - k * kLn2High, low = k * kLn2Low;
  const V r = high - low;
  const V rounding = (high - r) - low;
  const V p = 1.0 + (r + (r * r * polynomial(inverse_factorials, r) + rounding));
  const V half = nearest(0.5 * k);
  return p * power_of_two(half) * power_of_two(k - half);
}

/// With s = f / (2 + f): ln(1 + f) = 2 atanh(s) = f - f^2/2 + s (f^2/2 + 2 s^2/3 + 2 s^4/5 + ...).
static V log(V x) {
  static const double series[] = {2.0 / 3,  2.0 / 5,  2.0 / 7,  2.0 / 9,  2.0 / 11,
                                  2.0 / 13, 2.0 / 15, 2.0 / 17, 2.0 / 19, 2.0 / 21};
  const M tiny = x < 0x1p-1022;
  const V scaled = select(tiny, x * 0x1p54, x);
  // The exponent for which the fraction lies in [sqrt(1/2), sqrt(2)).
  const Bits bias = Bits{} + 1024;  // a shift of negative numbers is slow
  const Bits offset = Bits(broadcast(0x1.6a09e667f3bcdp-1)) - (bias << 52);
  const Bits k = Bits(Unsigned(Bits(scaled) - offset) >> 52) - bias;
  const V m = V(Bits(scaled) - (k << 52));
  const V exponent = from_integer(k) - select(tiny, broadcast(54.0), V{});
  const V f = m - 1.0;
  const V s = f / (2.0 + f);
  const V z = s * s, half_square = 0.5 * f * f;
  const V rest = s * (half_square + z * polynomial(series, z)) + exponent * kLn2Low;
  const V result = exponent * kLn2High - ((half_square - rest) - f);
  const double infinity = __builtin_inf();
  const V outside = select(x == 0.0, broadcast(-infinity),
                           select(x == infinity, x, broadcast(__builtin_nan(""))));
  return select((x > 0.0) & (x < infinity), result, outside);
}

// ---- sine, cosine, tangent ----------------------------------------------------------------------

/// x = quadrant pi/2 + y + rest, |y| <= pi/4.
struct Reduced {
  V quadrant;  // a whole number
  V y, rest;
};
/// What the rounded sum s of a and b lacks (Knuth).
GMSIM_INLINE V sum_error(V a, V b, V s) {
  const V part = s - a;
  return (a - (s - part)) + (b - part);
}
static Reduced reduce(V x) {
  const M large = ~(abs(x) < 0x1p20);
  const V n = select(large, V{}, nearest(x * 0x1.45f306dc9c883p-1));
  const V first = x - n * 0x1.921fb544p+0;  // exact, like both products below
  const V second = n * 0x1.0b4611a6p-34, third = n * 0x1.3198a2ep-69;
  const V a = first - second;
  const V b = a - third;
  const V low =
      (sum_error(first, -second, a) + sum_error(a, -third, b)) - n * 0x1.b839a252049c1p-104;
  Reduced result{n, b + low, V{}};
  result.rest = (b - result.y) + low;
  if (__builtin_expect(any(large), 0)) {
    for (std::size_t i = 0; i < kWidth; ++i) {
      if (!large[i]) continue;
      const QuadrantReduction lane = reduce_large_angle(x[i]);
      result.quadrant[i] = lane.quadrant;
      result.y[i] = lane.y;
      result.rest[i] = lane.rest;
    }
  }
  return result;
}
/// sin(y + rest) for |y| <= pi/4
GMSIM_INLINE V sine_series(V y, V rest) {
  static const double c[] = {
      1.0 / 120,        -1.0 / 5040,          1.0 / 362880,         -1.0 / 39916800,
      1.0 / 6227020800, -1.0 / 1307674368000, 1.0 / 355687428096000};
  const V z = y * y, cube = z * y;
  return y + (cube * (-1.0 / 6) + (z * (cube * polynomial(c, z) - 0.5 * rest) + rest));
}
/// cos(y + rest) for |y| <= pi/4
GMSIM_INLINE V cosine_series(V y, V rest) {
  static const double c[] = {
      1.0 / 24,        -1.0 / 720,         1.0 / 40320,          -1.0 / 3628800,
      1.0 / 479001600, -1.0 / 87178291200, 1.0 / 20922789888000, -1.0 / 6402373705728000};
  const V z = y * y, half = 0.5 * z, w = 1.0 - half;
  return w + (((1.0 - w) - half) + (z * z * polynomial(c, z) - y * rest));
}
struct SineCosine {
  V sine, cosine;
};
static SineCosine sine_cosine(V x) {
  const Reduced r = reduce(x);
  const V s = sine_series(r.y, r.rest), c = cosine_series(r.y, r.rest);
  const Bits quadrant = to_integer(r.quadrant);
  const M odd = M((quadrant & 1) != 0);
  const Bits sine_sign = (quadrant & 2) << 62, cosine_sign = ((quadrant + 1) & 2) << 62;
  return {V(Bits(select(odd, c, s)) ^ sine_sign), V(Bits(select(odd, s, c)) ^ cosine_sign)};
}
static V sin(V x) {
  return select(x == 0.0, x, sine_cosine(x).sine);
}
static V cos(V x) {
  return sine_cosine(x).cosine;
}
static V tan(V x) {
  const SineCosine r = sine_cosine(x);
  return select(x == 0.0, x, r.sine / r.cosine);
}

// ---- angles -------------------------------------------------------------------------------------

/// The angle in [0, pi] of (d, n), or of (-d, n) on the left; n and d not negative. One quotient t,
/// |t| <= 0.66, of which the angle differs by a multiple of pi/4.
static V angle(V n, V d, M left) {
  static const double series[] = {
      -0x1.5555555555555p-2, 0x1.9999999999962p-3, -0x1.249249248f9d4p-3, 0x1.c71c71c57e959p-4,
      -0x1.745d1703d2f6dp-4, 0x1.3b13aad759224p-4, -0x1.1110a898a9ef5p-4, 0x1.e1d89ab1de497p-5,
      -0x1.aedc835b14825p-5, 0x1.844f306a5dde8p-5, -0x1.5c2478c5ce56ep-5, 0x1.2c7f71dc2b9b5p-5,
      -0x1.d3d18ddfe3b4bp-6, 0x1.27a9cd32e53e4p-6, -0x1.025894f2d384ep-7, 0x1.c407caf97c809p-10};
  const V larger = select(n > d, n, d);
  const V factor = select(larger > 0x1p1000, broadcast(0x1p-100),
                          select(larger < 0x1p-900, broadcast(0x1p100), broadcast(1.0)));
  n = n * factor;
  d = d * factor;
  const M infinite = (n == d) & (n == __builtin_inf()), zero = (n == d) & (n == 0.0);
  const M flat = (n <= 0.66 * d) & ~infinite, steep = n > 2.4 * d;
  const M middle = ~(flat | steep);
  V t = select(middle, n - d, select(flat, n, -d)) / select(middle, n + d, select(flat, d, n));
  t = select(infinite | zero, V{}, t);  // the angle of the diagonal, or of the axis
  const V high = select(
      flat, V{}, select(middle, broadcast(0x1.921fb54442d18p-1), broadcast(0x1.921fb54442d18p+0)));
  const V low =
      select(flat, V{},
             select(middle, broadcast(0x1.1a62633145c07p-55), broadcast(0x1.1a62633145c07p-54)));
  const V left_high = select(flat, broadcast(0x1.921fb54442d18p+1),
                             select(middle, broadcast(0x1.2d97c7f3321d2p+1), high));
  const V left_low = select(flat, broadcast(0x1.1a62633145c07p-53),
                            select(middle, broadcast(0x1.a79394c9e8a0ap-54), low));
  const V z = t * t;
  const V bend = t * (z * polynomial(series, z));  // atan(t) - t
  const V to_right = high + (t + (bend + low)), to_left = left_high - (t + (bend - left_low));
  return select(left, to_left, to_right);
}
static V atan2(V y, V x) {
  const V result = with_sign(angle(abs(y), abs(x), M(Bits(x) < 0)), y);
  return select((x != x) | (y != y), x + y, result);
}
static V atan(V x) {
  return select(x != x, x, with_sign(angle(abs(x), broadcast(1.0), M{}), x));
}
/// The other leg of a right triangle with this leg and hypotenuse 1; not a number beyond 1.
GMSIM_INLINE V other_leg(V x) {
  return sqrt((1.0 - x) * (1.0 + x));
}
static V asin(V x) {
  const V leg = other_leg(x);
  return select(leg != leg, leg, with_sign(angle(abs(x), leg, M{}), x));
}
static V acos(V x) {
  const V leg = other_leg(x);
  return select(leg != leg, leg, angle(leg, abs(x), M(x < 0.0)));
}

static V tanh(V x) {
  static const double series[] = {
      -0x1.5555555555554p-2,  0x1.1111111110d0bp-3,  -0x1.ba1ba1b9b980dp-5,  0x1.664f48655da00p-6,
      -0x1.226e30ce60518p-7,  0x1.d6d2f9f4ec690p-9,  -0x1.7d96c83ab07c6p-10, 0x1.34da5f17f2478p-11,
      -0x1.eedc5fb5970e5p-13, 0x1.783a40bf12bd7p-14, -0x1.db3186df91306p-16, 0x1.5f79713fd9b18p-18};
  const V a = abs(x), z = x * x;
  const V near = a + a * (z * polynomial(series, z));
  const V far = 1.0 - 2.0 / (exp(2.0 * a) + 1.0);
  return select(x != x, x, with_sign(select(a < 0.7, near, far), x));
}
