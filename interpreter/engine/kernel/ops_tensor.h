// SPDX-License-Identifier: MIT
// Operations on vectors and matrices, with the order of additions of engine/ir_tensors.h. Included
// inside the namespace of one instruction set.

template <int N>
static void add(const Instruction& in, BlockFrame& f) {
  run<N, N, N>(in, f, [](Pack<N> a, const Pack<N>& b) {
    for (int k = 0; k < N; ++k) a.c[k] = a.c[k] + b.c[k];
    return a;
  });
}
template <int N>
static void subtract(const Instruction& in, BlockFrame& f) {
  run<N, N, N>(in, f, [](Pack<N> a, const Pack<N>& b) {
    for (int k = 0; k < N; ++k) a.c[k] = a.c[k] - b.c[k];
    return a;
  });
}
template <int N>
static void negate(const Instruction& in, BlockFrame& f) {
  run<N, N>(in, f, [](Pack<N> a) {
    for (int k = 0; k < N; ++k) a.c[k] = -a.c[k];
    return a;
  });
}
template <int N>
static void divide(const Instruction& in, BlockFrame& f) {
  run<N, N, 1>(in, f, [](Pack<N> a, const Pack<1>& b) {
    for (int k = 0; k < N; ++k) a.c[k] = a.c[k] / b.c[0];
    return a;
  });
}
template <int N>
static void scale(const Instruction& in, BlockFrame& f) {
  run<N, 1, N>(in, f, [](const Pack<1>& a, Pack<N> b) {
    for (int k = 0; k < N; ++k) b.c[k] = b.c[k] * a.c[0];
    return b;
  });
}
template <int N>
static void scale_add(const Instruction& in, BlockFrame& f) {
  run<N, 1, N, N>(in, f, [](const Pack<1>& a, Pack<N> b, const Pack<N>& c) {
    for (int k = 0; k < N; ++k) b.c[k] = b.c[k] * a.c[0] + c.c[k];
    return b;
  });
}
template <int N>
static void subtract_scaled(const Instruction& in, BlockFrame& f) {
  run<N, 1, N, N>(in, f, [](const Pack<1>& a, Pack<N> b, const Pack<N>& c) {
    for (int k = 0; k < N; ++k) b.c[k] = c.c[k] - b.c[k] * a.c[0];
    return b;
  });
}
template <int N>
static void choose(const Instruction& in, BlockFrame& f) {
  run<N, 1, N, N>(in, f, [](const Pack<1>& mask, Pack<N> b, const Pack<N>& c) {
    const M m = truth(mask.c[0]);
    for (int k = 0; k < N; ++k) b.c[k] = select(m, b.c[k], c.c[k]);
    return b;
  });
}

// ---- vectors ------------------------------------------------------------------------------------

GMSIM_INLINE V dot_product(const Pack<3>& a, const Pack<3>& b) {
  return a.c[0] * b.c[0] + a.c[1] * b.c[1] + a.c[2] * b.c[2];
}
GMSIM_INLINE Pack<3> over(const Pack<3>& a, V b) {
  return {{a.c[0] / b, a.c[1] / b, a.c[2] / b}};
}
GMSIM_INLINE Pack<3> cross_product(const Pack<3>& a, const Pack<3>& b) {
  return {{a.c[1] * b.c[2] - a.c[2] * b.c[1], a.c[2] * b.c[0] - a.c[0] * b.c[2],
           a.c[0] * b.c[1] - a.c[1] * b.c[0]}};
}
GMSIM_INLINE Pack<3> times(const Pack<3>& a, V b) {
  return {{a.c[0] * b, a.c[1] * b, a.c[2] * b}};
}
/// Squares of very short and very long vectors leave the range of numbers.
GMSIM_INLINE M square_is_safe(V squared) {
  return (squared > 1e-280) & (squared < 1e280);
}
GMSIM_INLINE V largest_entry(const Pack<3>& v) {
  V result = abs(v.c[0]);
  for (int k = 1; k < 3; ++k) result = select(result < abs(v.c[k]), abs(v.c[k]), result);
  return result;
}

/// |v| where its square is not safe.
static V careful_norm(const Pack<3>& v, V squared) {
  const V scale = largest_entry(v);
  const Pack<3> scaled = over(v, scale);
  const M as_it_is = (scale == 0.0) | ~(scale < __builtin_inf());
  return select(as_it_is, squared, scale * sqrt(dot_product(scaled, scaled)));
}
static Pack<3> careful_unit(const Pack<3>& v, M safe) {
  const V scale = select(safe, broadcast(1.0), largest_entry(v));
  const Pack<3> scaled = over(v, scale);
  Pack<3> unit = times(scaled, 1.0 / sqrt(dot_product(scaled, scaled)));
  for (int k = 0; k < 3; ++k) unit.c[k] = select(scale == 0.0, V{}, unit.c[k]);
  return unit;
}
static void norm(const Instruction& in, BlockFrame& f) {
  run<1, 3>(in, f, [](const Pack<3>& v) {
    const V squared = dot_product(v, v), length = sqrt(squared);
    const M safe = square_is_safe(squared);
    if (__builtin_expect(!any(~safe), 1)) return Pack<1>{{length}};
    return Pack<1>{{select(safe, length, careful_norm(v, squared))}};
  });
}
static void normalize(const Instruction& in, BlockFrame& f) {
  run<3, 3>(in, f, [](const Pack<3>& v) {
    const V squared = dot_product(v, v);
    const M safe = square_is_safe(squared);
    if (__builtin_expect(!any(~safe), 1)) return times(v, 1.0 / sqrt(squared));
    return careful_unit(v, safe);
  });
}
static void unit_and_norm(const Instruction& in, BlockFrame& f) {
  run<4, 3>(in, f, [](const Pack<3>& v) {
    const V squared = dot_product(v, v), length = sqrt(squared);
    const M safe = square_is_safe(squared);
    if (__builtin_expect(!any(~safe), 1)) {
      const Pack<3> unit = times(v, 1.0 / length);
      return Pack<4>{{unit.c[0], unit.c[1], unit.c[2], length}};
    }
    const Pack<3> unit = careful_unit(v, safe);
    return Pack<4>{
        {unit.c[0], unit.c[1], unit.c[2], select(safe, length, careful_norm(v, squared))}};
  });
}
static void vector(const Instruction& in, BlockFrame& f) {
  run<3, 1, 1, 1>(in, f, [](const Pack<1>& a, const Pack<1>& b, const Pack<1>& c) {
    return Pack<3>{{a.c[0], b.c[0], c.c[0]}};
  });
}
static void dot(const Instruction& in, BlockFrame& f) {
  run<1, 3, 3>(in, f,
               [](const Pack<3>& a, const Pack<3>& b) { return Pack<1>{{dot_product(a, b)}}; });
}
static void cross(const Instruction& in, BlockFrame& f) {
  run<3, 3, 3>(in, f, [](const Pack<3>& a, const Pack<3>& b) { return cross_product(a, b); });
}

// ---- matrices -----------------------------------------------------------------------------------

GMSIM_INLINE const Pack<9>& full_matrix(const Pack<9>& m) {
  return m;
}
/// xx, yy, zz, yz, xz, xy as a row-major matrix.
GMSIM_INLINE Pack<9> full_matrix(const Pack<6>& s) {
  return {{s.c[0], s.c[5], s.c[4], s.c[5], s.c[1], s.c[3], s.c[4], s.c[3], s.c[2]}};
}
GMSIM_INLINE Pack<6> symmetric_part(const Pack<9>& m) {
  return {{m.c[0], m.c[4], m.c[8], 0.5 * (m.c[5] + m.c[7]), 0.5 * (m.c[2] + m.c[6]),
           0.5 * (m.c[1] + m.c[3])}};
}
static void outer(const Instruction& in, BlockFrame& f) {
  run<9, 3, 3>(in, f, [](const Pack<3>& a, const Pack<3>& b) {
    Pack<9> m;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m.c[3 * i + j] = a.c[i] * b.c[j];
    return m;
  });
}
template <int N>
static void matrix_times_vector(const Instruction& in, BlockFrame& f) {
  run<3, N, 3>(in, f, [](const Pack<N>& a, const Pack<3>& v) {
    const Pack<9> m = full_matrix(a);
    Pack<3> d;
    for (int i = 0; i < 3; ++i)
      d.c[i] = m.c[3 * i] * v.c[0] + m.c[3 * i + 1] * v.c[1] + m.c[3 * i + 2] * v.c[2];
    return d;
  });
}
static void matrix_times_matrix(const Instruction& in, BlockFrame& f) {
  run<9, 9, 9>(in, f, [](const Pack<9>& a, const Pack<9>& b) {
    Pack<9> m;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        m.c[3 * i + j] =
            a.c[3 * i] * b.c[j] + a.c[3 * i + 1] * b.c[3 + j] + a.c[3 * i + 2] * b.c[6 + j];
    return m;
  });
}
static void transpose(const Instruction& in, BlockFrame& f) {
  run<9, 9>(in, f, [](const Pack<9>& m) {
    return Pack<9>{{m.c[0], m.c[3], m.c[6], m.c[1], m.c[4], m.c[7], m.c[2], m.c[5], m.c[8]}};
  });
}
template <int N>
static void trace(const Instruction& in, BlockFrame& f) {
  run<1, N>(in, f, [](const Pack<N>& a) {
    constexpr int step = N == 6 ? 1 : 4;
    return Pack<1>{{a.c[0] + a.c[step] + a.c[2 * step]}};
  });
}
/// The transposed matrix of cofactors: m times it is det(m) times the identity.
GMSIM_INLINE Pack<9> adjugate(const Pack<9>& m) {
  const V* c = m.c;
  return {{c[4] * c[8] - c[5] * c[7], c[2] * c[7] - c[1] * c[8], c[1] * c[5] - c[2] * c[4],
           c[5] * c[6] - c[3] * c[8], c[0] * c[8] - c[2] * c[6], c[2] * c[3] - c[0] * c[5],
           c[3] * c[7] - c[4] * c[6], c[1] * c[6] - c[0] * c[7], c[0] * c[4] - c[1] * c[3]}};
}
GMSIM_INLINE V determinant_from(const Pack<9>& m, const Pack<9>& cofactors) {
  return m.c[0] * cofactors.c[0] + m.c[1] * cofactors.c[3] + m.c[2] * cofactors.c[6];
}
template <int N>
static void determinant(const Instruction& in, BlockFrame& f) {
  run<1, N>(in, f, [](const Pack<N>& a) {
    const Pack<9> m = full_matrix(a);
    return Pack<1>{{determinant_from(m, adjugate(m))}};
  });
}
template <int N>
static void inverse(const Instruction& in, BlockFrame& f) {
  run<N, N>(in, f, [](const Pack<N>& a) {
    const Pack<9> m = full_matrix(a);
    Pack<9> cofactors = adjugate(m);
    const V det = determinant_from(m, cofactors);
    for (int k = 0; k < 9; ++k) cofactors.c[k] = cofactors.c[k] / det;
    if constexpr (N == 6) {
      return symmetric_part(cofactors);
    } else {
      return cofactors;
    }
  });
}
static void contract(const Instruction& in, BlockFrame& f) {
  run<1, 9, 9>(in, f, [](const Pack<9>& a, const Pack<9>& b) {
    V sum = a.c[0] * b.c[0];
    for (int k = 1; k < 9; ++k) sum += a.c[k] * b.c[k];
    return Pack<1>{{sum}};
  });
}
static void contract_symmetric(const Instruction& in, BlockFrame& f) {
  run<1, 6, 6>(in, f, [](const Pack<6>& a, const Pack<6>& b) {
    return Pack<1>{{(a.c[0] * b.c[0] + a.c[1] * b.c[1] + a.c[2] * b.c[2]) +
                    2.0 * (a.c[3] * b.c[3] + a.c[4] * b.c[4] + a.c[5] * b.c[5])}};
  });
}
static void symmetric(const Instruction& in, BlockFrame& f) {
  run<6, 9>(in, f, [](const Pack<9>& m) { return symmetric_part(m); });
}
static void full(const Instruction& in, BlockFrame& f) {
  run<9, 6>(in, f, [](const Pack<6>& s) { return full_matrix(s); });
}
static void columns(const Instruction& in, BlockFrame& f) {
  run<9, 3, 3, 3>(in, f, [](const Pack<3>& a, const Pack<3>& b, const Pack<3>& c) {
    Pack<9> m;
    for (int i = 0; i < 3; ++i) {
      m.c[3 * i] = a.c[i];
      m.c[3 * i + 1] = b.c[i];
      m.c[3 * i + 2] = c.c[i];
    }
    return m;
  });
}
static void diagonal(const Instruction& in, BlockFrame& f) {
  run<6, 3>(in, f, [](const Pack<3>& v) {
    return Pack<6>{{v.c[0], v.c[1], v.c[2], V{}, V{}, V{}}};
  });
}
