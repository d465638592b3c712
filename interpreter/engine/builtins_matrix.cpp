// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "engine/builtins.h"

namespace gmsim::engine {

using types::Builtin;

namespace {

/// xx, yy, zz, yz, xz, xy as a row-major matrix.
std::array<double, 9> full(const double* s) {
  return {s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2]};
}

void symmetric(const double* m, double* out) {
  const double s[6] = {m[0],
                       m[4],
                       m[8],
                       0.5 * (m[5] + m[7]),
                       0.5 * (m[2] + m[6]),
                       0.5 * (m[1] + m[3])};
  std::copy_n(s, 6, out);
}

/// The transposed matrix of cofactors: m times it is det(m) times the identity.
std::array<double, 9> adjugate(const double* m) {
  return {m[4] * m[8] - m[5] * m[7], m[2] * m[7] - m[1] * m[8], m[1] * m[5] - m[2] * m[4],
          m[5] * m[6] - m[3] * m[8], m[0] * m[8] - m[2] * m[6], m[2] * m[3] - m[0] * m[5],
          m[3] * m[7] - m[4] * m[6], m[1] * m[6] - m[0] * m[7], m[0] * m[4] - m[1] * m[3]};
}

double determinant(const double* m, const std::array<double, 9>& cofactors) {
  return m[0] * cofactors[0] + m[1] * cofactors[3] + m[2] * cofactors[6];
}

double determinant2(const double* m) { return m[0] * m[3] - m[1] * m[2]; }

void inverse3(const double* m, double* out) {
  const std::array<double, 9> cofactors = adjugate(m);
  const double det = determinant(m, cofactors);
  for (int i = 0; i < 9; ++i) out[i] = cofactors[i] / det;
}

void inverse2(const double* m, double* out) {
  const double det = determinant2(m);
  const double result[4] = {m[3] / det, -m[1] / det, -m[2] / det, m[0] / det};
  std::copy_n(result, 4, out);
}

void transpose(const double* m, int n, double* out) {
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) out[n * i + j] = m[n * j + i];
  }
}

}  // namespace

template <>
void run_builtin<Builtin::Det>(const BuiltinCall& call, double* out) {
  switch (call.overload) {
    case 0:
      *out = determinant(call[0], adjugate(call[0]));
      return;
    case 1:
      *out = determinant2(call[0]);
      return;
    default: {
      const std::array<double, 9> m = full(call[0]);
      *out = determinant(m.data(), adjugate(m.data()));
    }
  }
}
template <>
void run_builtin<Builtin::Inverse>(const BuiltinCall& call, double* out) {
  switch (call.overload) {
    case 0:
      return inverse3(call[0], out);
    case 1:
      return inverse2(call[0], out);
    default: {
      std::array<double, 9> result;
      inverse3(full(call[0]).data(), result.data());
      symmetric(result.data(), out);
    }
  }
}
template <>
void run_builtin<Builtin::Transpose>(const BuiltinCall& call, double* out) {
  transpose(call[0], 3 - call.overload, out);
}
template <>
void run_builtin<Builtin::Trace>(const BuiltinCall& call, double* out) {
  const double* m = call[0];
  switch (call.overload) {
    case 0:
      *out = m[0] + m[4] + m[8];
      return;
    case 1:
      *out = m[0] + m[3];
      return;
    default:
      *out = m[0] + m[1] + m[2];
  }
}
template <>
void run_builtin<Builtin::Sym>(const BuiltinCall& call, double* out) {
  symmetric(call[0], out);
}
template <>
void run_builtin<Builtin::Mat>(const BuiltinCall& call, double* out) {
  const std::array<double, 9> m = full(call[0]);
  std::copy_n(m.data(), 9, out);
}
template <>
void run_builtin<Builtin::Columns3>(const BuiltinCall& call, double* out) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) out[3 * i + j] = call[j][i];
  }
}
template <>
void run_builtin<Builtin::Rows3>(const BuiltinCall& call, double* out) {
  const int n = 3 - call.overload;
  for (int i = 0; i < n; ++i) std::copy_n(call[i], n, out + n * i);
}
template <>
void run_builtin<Builtin::Diagonal>(const BuiltinCall& call, double* out) {
  const double s[6] = {call[0][0], call[0][1], call[0][2], 0.0, 0.0, 0.0};
  std::copy_n(s, 6, out);
}
template <>
void run_builtin<Builtin::Identity3>(const BuiltinCall&, double* out) {
  for (int i = 0; i < 9; ++i) out[i] = i % 4 == 0 ? 1.0 : 0.0;
}
template <>
void run_builtin<Builtin::Identity2>(const BuiltinCall&, double* out) {
  for (int i = 0; i < 4; ++i) out[i] = i % 3 == 0 ? 1.0 : 0.0;
}
template <>
void run_builtin<Builtin::Contract>(const BuiltinCall& call, double* out) {
  const double *a = call[0], *b = call[1];
  if (call.overload == 1) {  // entries off the diagonal stand for two
    *out = (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) +
           2.0 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
    return;
  }
  double sum = a[0] * b[0];
  for (int i = 1; i < (call.overload == 0 ? 9 : 4); ++i) sum += a[i] * b[i];
  *out = sum;
}

}  // namespace gmsim::engine
