// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/builtins.h"

/// The vector and matrix operations of compile/ir_ops.def on plain numbers, with the order of
/// additions that the tree evaluator has and the block kernels must have.
namespace gmsim::engine::ir_tensors {

template <typename N>
using Entries = std::array<N, 9>;

template <typename N>
N dot(const Entries<N>& a, const Entries<N>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <typename N>
Entries<N> cross(const Entries<N>& a, const Entries<N>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <typename N>
N largest(const Entries<N>& v) {
  return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
}
/// Squares of very short and very long vectors leave the range of numbers.
template <typename N>
bool square_is_safe(N squared) {
  return squared > N(1e-280) && squared < N(1e280);
}
template <typename N>
N norm(const Entries<N>& v) {
  const N squared = dot(v, v);
  if (square_is_safe(squared)) return std::sqrt(squared);
  const N scale = largest(v);
  if (scale == 0 || !std::isfinite(scale)) return squared;
  const Entries<N> scaled = {v[0] / scale, v[1] / scale, v[2] / scale};
  return scale * std::sqrt(dot(scaled, scaled));
}
template <typename N>
Entries<N> normalize(const Entries<N>& v) {
  const N scale = square_is_safe(dot(v, v)) ? N(1) : largest(v);
  if (scale == 0) return {};
  const Entries<N> scaled = {v[0] / scale, v[1] / scale, v[2] / scale};
  const N inverse = 1 / std::sqrt(dot(scaled, scaled));
  return {scaled[0] * inverse, scaled[1] * inverse, scaled[2] * inverse};
}
template <typename N>
Entries<N> outer(const Entries<N>& a, const Entries<N>& b) {
  Entries<N> m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m[3 * i + j] = a[i] * b[j];
  return m;
}
template <typename N>
Entries<N> matrix_times_vector(const Entries<N>& m, const Entries<N>& v) {
  Entries<N> out{};
  for (int i = 0; i < 3; ++i) out[i] = m[3 * i] * v[0] + m[3 * i + 1] * v[1] + m[3 * i + 2] * v[2];
  return out;
}
template <typename N>
Entries<N> matrix_times_matrix(const Entries<N>& a, const Entries<N>& b) {
  Entries<N> m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      m[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
  return m;
}
template <typename N>
Entries<N> transpose(const Entries<N>& m) {
  return {m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]};
}
/// xx, yy, zz, yz, xz, xy as a row-major matrix.
template <typename N>
Entries<N> full(const Entries<N>& s) {
  return {s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2]};
}
template <typename N>
Entries<N> symmetric(const Entries<N>& m) {
  const N half(0.5);
  return {m[0], m[4], m[8], half * (m[5] + m[7]), half * (m[2] + m[6]), half * (m[1] + m[3])};
}
template <typename N>
Entries<N> columns(const Entries<N>& a, const Entries<N>& b, const Entries<N>& c) {
  return {a[0], b[0], c[0], a[1], b[1], c[1], a[2], b[2], c[2]};
}
/// The transposed matrix of cofactors: m times it is det(m) times the identity.
template <typename N>
Entries<N> adjugate(const Entries<N>& m) {
  return {m[4] * m[8] - m[5] * m[7], m[2] * m[7] - m[1] * m[8], m[1] * m[5] - m[2] * m[4],
          m[5] * m[6] - m[3] * m[8], m[0] * m[8] - m[2] * m[6], m[2] * m[3] - m[0] * m[5],
          m[3] * m[7] - m[4] * m[6], m[1] * m[6] - m[0] * m[7], m[0] * m[4] - m[1] * m[3]};
}
template <typename N>
N determinant(const Entries<N>& m) {
  const Entries<N> c = adjugate(m);
  return m[0] * c[0] + m[1] * c[3] + m[2] * c[6];
}
template <typename N>
Entries<N> inverse(const Entries<N>& m) {
  Entries<N> c = adjugate(m);
  const N det = m[0] * c[0] + m[1] * c[3] + m[2] * c[6];
  for (N& entry : c) entry /= det;
  return c;
}
template <typename N>
N contract(const Entries<N>& a, const Entries<N>& b) {
  N sum = a[0] * b[0];
  for (int i = 1; i < 9; ++i) sum += a[i] * b[i];
  return sum;
}
/// Entries off the diagonal stand for two.
template <typename N>
N contract_symmetric(const Entries<N>& a, const Entries<N>& b) {
  return (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) +
         N(2) * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}
template <typename N>
Entries<N> polar(const Entries<N>& m) {
  double in[9], out[9];
  std::copy(m.begin(), m.end(), in);
  polar_rotation3(in, out);
  Entries<N> r;
  std::copy(out, out + 9, r.begin());
  return r;
}
/// Value and unit vector number `which` (0 largest, 2 smallest) of a symmetric matrix.
template <typename N>
Entries<N> eigenpair(const Entries<N>& s, int which) {
  double in[6], values[3], vectors[3][3];
  std::copy_n(s.begin(), 6, in);
  eigen_symmetric3(in, values, vectors);
  const double* vector = vectors[which];
  return {static_cast<N>(values[which]), static_cast<N>(vector[0]), static_cast<N>(vector[1]),
          static_cast<N>(vector[2])};
}

}  // namespace gmsim::engine::ir_tensors
