// SPDX-License-Identifier: MIT
// Loops over the lanes of a block, and operations from numbers to numbers. Included inside the
// namespace of one instruction set.

/// d := operation(a …) for all lanes; R, A, B, C are the rows of the result and of the operands.
template <int R, int A, typename Operation>
GMSIM_INLINE void run(const Instruction& in, BlockFrame& f, const Operation& operation) {
  const Reader a = reader(f, in.operands[0]);
  const Writer d = writer(f, in.d);
  each_vector(f.active, [&](std::size_t i) { write<R>(d, i, operation(read<A>(a, i))); });
}
template <int R, int A, int B, typename Operation>
GMSIM_INLINE void run(const Instruction& in, BlockFrame& f, const Operation& operation) {
  const Reader a = reader(f, in.operands[0]), b = reader(f, in.operands[1]);
  const Writer d = writer(f, in.d);
  if ((a.moving & b.moving) != 0) {
    each_vector(f.active, [&](std::size_t i) {
      write<R>(d, i, operation(read_moving<A>(a, i), read_moving<B>(b, i)));
    });
  } else {
    each_vector(f.active,
                [&](std::size_t i) { write<R>(d, i, operation(read<A>(a, i), read<B>(b, i))); });
  }
}
template <int R, int A, int B, int C, typename Operation>
GMSIM_INLINE void run(const Instruction& in, BlockFrame& f, const Operation& operation) {
  const Reader a = reader(f, in.operands[0]), b = reader(f, in.operands[1]);
  const Reader c = reader(f, in.operands[2]);
  const Writer d = writer(f, in.d);
  if ((a.moving & b.moving & c.moving) != 0) {
    each_vector(f.active, [&](std::size_t i) {
      write<R>(d, i, operation(read_moving<A>(a, i), read_moving<B>(b, i), read_moving<C>(c, i)));
    });
  } else {
    each_vector(f.active, [&](std::size_t i) {
      write<R>(d, i, operation(read<A>(a, i), read<B>(b, i), read<C>(c, i)));
    });
  }
}

// name(a, b, c): one line of arithmetic on numbers.
#define GMSIM_UNARY(name, expression)                      \
  static void name(const Instruction& in, BlockFrame& f) { \
    run<1, 1>(in, f, [](const Pack<1>& x) {                \
      const V a = x.c[0];                                  \
      return Pack<1>{{expression}};                        \
    });                                                    \
  }
#define GMSIM_BINARY(name, expression)                           \
  static void name(const Instruction& in, BlockFrame& f) {       \
    run<1, 1, 1>(in, f, [](const Pack<1>& x, const Pack<1>& y) { \
      const V a = x.c[0], b = y.c[0];                            \
      return Pack<1>{{expression}};                              \
    });                                                          \
  }
#define GMSIM_TERNARY(name, expression)                                               \
  static void name(const Instruction& in, BlockFrame& f) {                            \
    run<1, 1, 1, 1>(in, f, [](const Pack<1>& x, const Pack<1>& y, const Pack<1>& z) { \
      const V a = x.c[0], b = y.c[0], c = z.c[0];                                     \
      return Pack<1>{{expression}};                                                   \
    });                                                                               \
  }

GMSIM_TERNARY(mul_add, a* b + c)
GMSIM_TERNARY(mul_sub, a* b - c)
GMSIM_TERNARY(sub_mul, c - a * b)
GMSIM_BINARY(mul, a* b)
GMSIM_UNARY(square_root, sqrt(a))
GMSIM_UNARY(absolute, abs(a))
GMSIM_UNARY(sign, number(a > 0.0) - number(a < 0.0))
GMSIM_BINARY(minimum, select(b < a, b, a))
GMSIM_BINARY(maximum, select(a < b, b, a))
GMSIM_UNARY(round_down, floor(a))
GMSIM_UNARY(round_up, ceil(a))
GMSIM_BINARY(less, number(a < b))
GMSIM_BINARY(less_equal, number(a <= b))
GMSIM_BINARY(equal, number(a == b))
GMSIM_BINARY(both, number(truth(a) & truth(b)))
GMSIM_BINARY(either, number(truth(a) | truth(b)))
GMSIM_UNARY(negation, number(a == 0.0))
GMSIM_UNARY(exponential, exp(a))
GMSIM_UNARY(logarithm, log(a))
GMSIM_UNARY(sine, sin(a))
GMSIM_UNARY(cosine, cos(a))
GMSIM_UNARY(tangent, tan(a))
GMSIM_UNARY(arc_sine, asin(a))
GMSIM_UNARY(arc_cosine, acos(a))
GMSIM_UNARY(arc_tangent, atan(a))
GMSIM_BINARY(arc_tangent2, atan2(a, b))
GMSIM_UNARY(hyperbolic_tangent, tanh(a))

#undef GMSIM_UNARY
#undef GMSIM_BINARY
#undef GMSIM_TERNARY

/// Operations without vector code run lane by lane.
GMSIM_INLINE V each_lane(V a, V b, double (*function)(double, double)) {
  for (std::size_t k = 0; k < kWidth; ++k) a[k] = function(a[k], b[k]);
  return a;
}
static void power_of(const Instruction& in, BlockFrame& f) {
  run<1, 1, 1>(in, f, [](const Pack<1>& a, const Pack<1>& b) {
    return Pack<1>{{each_lane(a.c[0], b.c[0], &engine::power)}};
  });
}
static void remainder(const Instruction& in, BlockFrame& f) {
  run<1, 1, 1>(in, f, [](const Pack<1>& a, const Pack<1>& b) {
    return Pack<1>{{each_lane(a.c[0], b.c[0], &engine::modulo)}};
  });
}
static void whole_power(const Instruction& in, BlockFrame& f) {
  const int exponent = static_cast<int>(in.numbers[0]);
  run<1, 1>(in, f, [exponent](const Pack<1>& a) {
    V result = broadcast(1.0), square = a.c[0];
    for (int rest = exponent < 0 ? -exponent : exponent; rest != 0; rest >>= 1, square *= square)
      if ((rest & 1) != 0) result *= square;
    return Pack<1>{{exponent < 0 ? 1.0 / result : result}};
  });
}
