// SPDX-License-Identifier: MIT
// Vectors of doubles as wide as the instruction set has them. Included inside the namespace of one
// instruction set, after <immintrin.h>; uses the compiler's own vector types, whose operators are
// part of the language and not code that translation units could share.

#define GMSIM_INLINE static inline __attribute__((always_inline))

constexpr std::size_t kWidth = GMSIM_VECTOR_BYTES / sizeof(double);
typedef double V __attribute__((vector_size(GMSIM_VECTOR_BYTES)));
typedef long long Bits __attribute__((vector_size(GMSIM_VECTOR_BYTES)));
typedef decltype(V{} < V{}) M;  // all bits set where true
typedef double Stored __attribute__((vector_size(GMSIM_VECTOR_BYTES), may_alias));

GMSIM_INLINE V broadcast(double x) {
  return x - V{};
}
GMSIM_INLINE V load(const double* p) {
  return *reinterpret_cast<const Stored*>(p);
}
GMSIM_INLINE void store(double* p, V x) {
  *reinterpret_cast<Stored*>(p) = x;
}
GMSIM_INLINE V select(M m, V a, V b) {
  return m ? a : b;
}
GMSIM_INLINE V abs(V x) {
  return V(Bits(x) & 0x7fffffffffffffff);
}
GMSIM_INLINE Bits sign_bits(V x) {
  return Bits(x) & (-0x7fffffffffffffff - 1);
}
/// x >= 0 with the sign of `sign`.
GMSIM_INLINE V with_sign(V x, V sign) {
  return V(Bits(x) | sign_bits(sign));
}
/// Masks in registers are 0 or 1.
GMSIM_INLINE V number(M m) {
  return V(Bits(m) & Bits(broadcast(1.0)));
}
GMSIM_INLINE M truth(V x) {
  return x != 0.0;
}

#if GMSIM_VECTOR_BYTES == 64
GMSIM_INLINE V sqrt(V x) {
  return V(_mm512_sqrt_pd(__m512d(x)));
}
GMSIM_INLINE bool any(M m) {
  return _mm512_test_epi64_mask(__m512i(m), __m512i(m)) != 0;
}
#elif GMSIM_VECTOR_BYTES == 32
GMSIM_INLINE V sqrt(V x) {
  return V(_mm256_sqrt_pd(__m256d(x)));
}
GMSIM_INLINE bool any(M m) {
  return _mm256_movemask_pd(__m256d(m)) != 0;
}
#elif defined(__SSE2__)
GMSIM_INLINE V sqrt(V x) {
  return V(_mm_sqrt_pd(__m128d(x)));
}
GMSIM_INLINE bool any(M m) {
  return _mm_movemask_pd(__m128d(m)) != 0;
}
#else
GMSIM_INLINE V sqrt(V x) {
  for (std::size_t i = 0; i < kWidth; ++i) x[i] = __builtin_sqrt(x[i]);
  return x;
}
GMSIM_INLINE bool any(M m) {
  bool result = false;
  for (std::size_t i = 0; i < kWidth; ++i) result = result || m[i] != 0;
  return result;
}
#endif

/// The nearest whole number, for |x| < 2^51.
GMSIM_INLINE V nearest(V x) {
  const V shift = with_sign(broadcast(0x1p52), x);
  return (x + shift) - shift;
}
GMSIM_INLINE V floor(V x) {
  const V rounded = nearest(x);
  const V below = select(rounded > x, rounded - 1.0, rounded);
  return select(abs(x) < 0x1p52, with_sign(abs(below), select(below == 0.0, x, below)), x);
}
GMSIM_INLINE V ceil(V x) {
  return -floor(-x);
}

/// The entries of a value for kWidth matches.
template <int N>
struct Pack {
  V c[N];
};

/// Where an operand is read: uniform ones always in their first lanes.
struct Reader {
  const double* first;
  std::size_t row;
  std::size_t moving;
};
GMSIM_INLINE Reader reader(const BlockFrame& frame, const compile::Register& r) {
  return {frame.registers + r.offset, r.uniform ? compile::kUniformLanes : frame.row,
          r.uniform ? std::size_t(0) : ~std::size_t(0)};
}
template <int N>
GMSIM_INLINE Pack<N> read(const Reader& from, std::size_t lane) {
  Pack<N> pack;
  const double* at = from.first + (lane & from.moving);
  for (int k = 0; k < N; ++k) pack.c[k] = load(at + k * from.row);
  return pack;
}
/// The same from a register that is not uniform.
template <int N>
GMSIM_INLINE Pack<N> read_moving(const Reader& from, std::size_t lane) {
  Pack<N> pack;
  for (int k = 0; k < N; ++k) pack.c[k] = load(from.first + lane + k * from.row);
  return pack;
}
struct Writer {
  double* first;
  std::size_t row;
};
GMSIM_INLINE Writer writer(const BlockFrame& frame, const compile::Register& r) {
  return {frame.registers + r.offset, r.uniform ? compile::kUniformLanes : frame.row};
}
template <int N>
GMSIM_INLINE void write(const Writer& to, std::size_t lane, const Pack<N>& pack) {
  for (int k = 0; k < N; ++k) store(to.first + lane + k * to.row, pack.c[k]);
}

/// body(lane) for the first lane of each vector, some vectors a turn.
template <typename Body>
GMSIM_INLINE void each_vector(std::size_t lanes, const Body& body) {
  for (std::size_t i = 0; i < lanes; i += compile::kUniformLanes)
    for (std::size_t k = 0; k < compile::kUniformLanes; k += kWidth) body(i + k);
}
