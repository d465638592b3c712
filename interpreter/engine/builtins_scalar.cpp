// SPDX-License-Identifier: MIT
#include <cmath>

#include "engine/builtins.h"
#include "engine/kernel/lane_functions.h"

namespace gmsim::engine {

using types::Builtin;

namespace {

double whole_power(double x, unsigned exponent) {
  double result = 1.0;
  for (double square = x; exponent != 0; exponent >>= 1u, square *= square) {
    if ((exponent & 1u) != 0) result *= square;
  }
  return result;
}

}  // namespace

double power(double x, double y) {
  constexpr double kLargest = 64.0;
  if (y == std::floor(y) && std::abs(y) <= kLargest) {
    const double result = whole_power(x, static_cast<unsigned>(std::abs(y)));
    return y < 0.0 ? 1.0 / result : result;
  }
  if (y == 0.5) return std::sqrt(x);
  return general_power(x, y);
}

template <>
void run_builtin<Builtin::Abs>(const BuiltinCall& call, double* out) {
  *out = std::abs(*call[0]);
}
template <>
void run_builtin<Builtin::Sign>(const BuiltinCall& call, double* out) {
  const double x = *call[0];
  *out = static_cast<double>(x > 0.0) - static_cast<double>(x < 0.0);
}
template <>
void run_builtin<Builtin::Min>(const BuiltinCall& call, double* out) {
  *out = *call[1] < *call[0] ? *call[1] : *call[0];
}
template <>
void run_builtin<Builtin::Max>(const BuiltinCall& call, double* out) {
  *out = *call[0] < *call[1] ? *call[1] : *call[0];
}
template <>
void run_builtin<Builtin::Clamp>(const BuiltinCall& call, double* out) {
  const double x = *call[0];
  *out = x < *call[1] ? *call[1] : x > *call[2] ? *call[2] : x;
}
template <>
void run_builtin<Builtin::Floor>(const BuiltinCall& call, double* out) {
  *out = std::floor(*call[0]);
}
template <>
void run_builtin<Builtin::Ceil>(const BuiltinCall& call, double* out) {
  *out = std::ceil(*call[0]);
}
template <>
void run_builtin<Builtin::Mod>(const BuiltinCall& call, double* out) {
  *out = modulo(*call[0], *call[1]);
}
template <>
void run_builtin<Builtin::Sqrt>(const BuiltinCall& call, double* out) {
  *out = std::sqrt(*call[0]);
}
template <>
void run_builtin<Builtin::Exp>(const BuiltinCall& call, double* out) {
  *out = fixed_order::exp(*call[0]);
}
template <>
void run_builtin<Builtin::Log>(const BuiltinCall& call, double* out) {
  *out = fixed_order::log(*call[0]);
}
template <>
void run_builtin<Builtin::Sin>(const BuiltinCall& call, double* out) {
  *out = fixed_order::sin(*call[0]);
}
template <>
void run_builtin<Builtin::Cos>(const BuiltinCall& call, double* out) {
  *out = fixed_order::cos(*call[0]);
}
template <>
void run_builtin<Builtin::Tan>(const BuiltinCall& call, double* out) {
  *out = fixed_order::tan(*call[0]);
}
template <>
void run_builtin<Builtin::Asin>(const BuiltinCall& call, double* out) {
  *out = fixed_order::asin(*call[0]);
}
template <>
void run_builtin<Builtin::Acos>(const BuiltinCall& call, double* out) {
  *out = fixed_order::acos(*call[0]);
}
template <>
void run_builtin<Builtin::Atan>(const BuiltinCall& call, double* out) {
  *out = fixed_order::atan(*call[0]);
}
template <>
void run_builtin<Builtin::Atan2>(const BuiltinCall& call, double* out) {
  *out = fixed_order::atan2(*call[0], *call[1]);
}
template <>
void run_builtin<Builtin::Tanh>(const BuiltinCall& call, double* out) {
  *out = fixed_order::tanh(*call[0]);
}
template <>
void run_builtin<Builtin::Real>(const BuiltinCall& call, double* out) {
  *out = *call[0];
}

}  // namespace gmsim::engine
