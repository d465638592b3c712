// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "engine/builtins.h"

namespace gmsim::engine {

using types::Builtin;

namespace {

/// Components of the argument of overload 0 (vec3), 1 (vec2), 2 (real).
int dimension(int overload) { return 3 - overload; }

double squared_norm(const double* v, int n) {
  double sum = v[0] * v[0];
  for (int i = 1; i < n; ++i) sum += v[i] * v[i];
  return sum;
}

double largest(const double* v, int n) {
  double result = 0.0;
  for (int i = 0; i < n; ++i) result = std::max(result, std::abs(v[i]));
  return result;
}

/// Squares of very short and very long vectors leave the range of numbers.
bool square_is_safe(double squared) { return squared > 1e-280 && squared < 1e280; }

double norm(const double* v, int n) {
  const double squared = squared_norm(v, n);
  if (square_is_safe(squared)) return std::sqrt(squared);
  const double scale = largest(v, n);
  if (scale == 0.0 || !std::isfinite(scale)) return squared;
  double scaled[3];
  for (int i = 0; i < n; ++i) scaled[i] = v[i] / scale;
  return scale * std::sqrt(squared_norm(scaled, n));
}

void normalize(const double* v, int n, double* out) {
  double scaled[3];
  const double squared = squared_norm(v, n);
  const double scale = square_is_safe(squared) ? 1.0 : largest(v, n);
  if (scale == 0.0) return void(std::fill_n(out, n, 0.0));
  for (int i = 0; i < n; ++i) scaled[i] = v[i] / scale;
  const double inverse = 1.0 / std::sqrt(squared_norm(scaled, n));
  for (int i = 0; i < n; ++i) out[i] = scaled[i] * inverse;
}

}  // namespace

template <>
void run_builtin<Builtin::Norm>(const BuiltinCall& call, double* out) {
  *out = call.overload == 2 ? std::abs(*call[0]) : norm(call[0], dimension(call.overload));
}
template <>
void run_builtin<Builtin::Normalize>(const BuiltinCall& call, double* out) {
  normalize(call[0], dimension(call.overload), out);
}
template <>
void run_builtin<Builtin::Dot>(const BuiltinCall& call, double* out) {
  double sum = call[0][0] * call[1][0];
  for (int i = 1; i < dimension(call.overload); ++i) sum += call[0][i] * call[1][i];
  *out = sum;
}
template <>
void run_builtin<Builtin::Cross>(const BuiltinCall& call, double* out) {
  const double *a = call[0], *b = call[1];
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}
template <>
void run_builtin<Builtin::Outer>(const BuiltinCall& call, double* out) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) out[3 * i + j] = call[0][i] * call[1][j];
  }
}

}  // namespace gmsim::engine
