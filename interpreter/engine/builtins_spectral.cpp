// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/builtins.h"
#include "engine/kernel/lane_functions.h"

namespace gmsim::engine {

using types::Builtin;

namespace {

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;

constexpr int kMaxSweeps = 30;  // cyclic Jacobi on a 3x3 needs about six
constexpr std::array<std::pair<int, int>, 3> kPairs = {{{0, 1}, {0, 2}, {1, 2}}};
constexpr Matrix kIdentity = {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector scaled(const Vector& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
Vector unit(const Vector& a) {
  const double length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

/// The largest power of two not above the largest entry; 0 when all are zero or one is not finite.
/// Dividing by it is exact, so scaling changes no digit.
double power_of_two_scale(const double* entries, int count) {
  double largest = 0.0;
  for (int i = 0; i < count; ++i) {
    if (!std::isfinite(entries[i])) return 0.0;
    largest = std::max(largest, std::abs(entries[i]));
  }
  return largest == 0.0 ? 0.0 : std::ldexp(1.0, std::ilogb(largest));
}

/// The rotation (c, s) that makes the off-diagonal entry `pq` of a symmetric 2x2 matrix zero
/// (Golub & Van Loan, Matrix Computations, symmetric Schur decomposition).
std::pair<double, double> jacobi_rotation(double pp, double pq, double qq) {
  const double tau = (qq - pp) / (2.0 * pq);
  const double t = (tau >= 0.0 ? 1.0 : -1.0) / (std::abs(tau) + std::sqrt(1.0 + tau * tau));
  const double c = 1.0 / std::sqrt(1.0 + t * t);
  return {c, t * c};
}

/// row_p, row_q := c row_p - s row_q, s row_p + c row_q
void rotate_rows(Vector& p, Vector& q, double c, double s) {
  for (int i = 0; i < 3; ++i) {
    const double x = p[i], y = q[i];
    p[i] = c * x - s * y;
    q[i] = s * x + c * y;
  }
}

void rotate_columns(Matrix& a, int p, int q, double c, double s) {
  for (Vector& row : a) {
    const double x = row[p], y = row[q];
    row[p] = c * x - s * y;
    row[q] = s * x + c * y;
  }
}

/// Two-sided Jacobi: a becomes diagonal, the rows of v its eigenvectors.
void diagonalise(Matrix& a, Matrix& v) {
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    bool changed = false;
    for (const auto& [p, q] : kPairs) {
      if (std::abs(a[p][q]) <= 1e-300) continue;  // entries are below 2 in magnitude
      const auto [c, s] = jacobi_rotation(a[p][p], a[p][q], a[q][q]);
      changed = changed || std::abs(a[p][q]) > 1e-17 * (std::abs(a[p][p]) + std::abs(a[q][q]));
      rotate_rows(a[p], a[q], c, s);
      rotate_columns(a, p, q, c, s);
      a[p][q] = a[q][p] = 0.0;
      rotate_rows(v[p], v[q], c, s);
    }
    if (!changed) return;
  }
}

/// One-sided Jacobi: makes the rows of b orthogonal by rotations that v collects; accurate for
/// small singular values too, which the eigenvalues of F^T F are not.
void orthogonalise(Matrix& b, Matrix& v) {
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    bool changed = false;
    for (const auto& [p, q] : kPairs) {
      const double pp = dot(b[p], b[p]), pq = dot(b[p], b[q]), qq = dot(b[q], b[q]);
      if (std::abs(pq) <= 1e-16 * std::sqrt(pp * qq)) continue;
      const auto [c, s] = jacobi_rotation(pp, pq, qq);
      rotate_rows(b[p], b[q], c, s);
      rotate_rows(v[p], v[q], c, s);
      changed = true;
    }
    if (!changed) return;
  }
}

void sort_descending(Matrix& b, Matrix& v) {
  for (const auto& [p, q] : kPairs) {
    if (dot(b[p], b[p]) >= dot(b[q], b[q])) continue;
    std::swap(b[p], b[q]);
    std::swap(v[p], v[q]);
  }
}

/// A vector orthogonal to the unit vector a, of unit length.
Vector perpendicular(const Vector& a) {
  int smallest = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(a[i]) < std::abs(a[smallest])) smallest = i;
  }
  return unit(cross(a, kIdentity[smallest]));
}

/// The image of the unit vector x, orthogonal to `from`, under the shortest rotation that takes the
/// unit vector `from` to `to`.
Vector carried(const Vector& x, const Vector& from, const Vector& to) {
  const double cosine = dot(from, to);
  if (cosine < -1.0 + 1e-12) {  // half a turn about an axis orthogonal to `from`
    const Vector axis = perpendicular(from);
    const double along = 2.0 * dot(axis, x);
    return {along * axis[0] - x[0], along * axis[1] - x[1], along * axis[2] - x[2]};
  }
  const double factor = dot(to, x) / (1.0 + cosine);
  Vector result;
  for (int i = 0; i < 3; ++i) result[i] = x[i] - factor * (from[i] + to[i]);
  return result;
}

/// The second left singular vector: b made orthogonal to u1, or where b vanishes what the shortest
/// rotation v1 -> u1 makes of v2.
Vector second_vector(const Vector& b, const Vector& u1, const Vector& v1, const Vector& v2,
                     double largest) {
  const double along = dot(b, u1);
  const Vector rest = {b[0] - along * u1[0], b[1] - along * u1[1], b[2] - along * u1[2]};
  const double length = std::sqrt(dot(rest, rest));
  if (length > 1e-15 * largest) return unit(rest);
  const Vector guess = carried(v2, v1, u1);
  const double off = dot(guess, u1);
  return unit({guess[0] - off * u1[0], guess[1] - off * u1[1], guess[2] - off * u1[2]});
}

void write_eigenpair(int which, const BuiltinCall& call, double* out) {
  double values[3], vectors[3][3];
  eigen_symmetric3(call[0], values, vectors);
  out[0] = values[which];
  std::copy_n(vectors[which], 3, out + 1);
}

/// The rotation closest to a 2x2 matrix: its angle has cosine and sine proportional to the trace
/// and to the antisymmetric part. A multiple of a reflection has no closest one: the identity.
void polar_rotation2(const double* f, double* r) {
  const double c = f[0] + f[3], s = f[2] - f[1];
  const double length = std::hypot(c, s);
  const double cosine = length == 0.0 ? 1.0 : c / length, sine = length == 0.0 ? 0.0 : s / length;
  r[0] = r[3] = cosine;
  r[1] = -sine;
  r[2] = sine;
}

}  // namespace

void eigen_symmetric3(const double* matrix, double values[3], double vectors[3][3]) {
  const double scale = power_of_two_scale(matrix, 6);
  Matrix v = kIdentity;
  Matrix a = {};
  if (scale != 0.0) {
    double m[6];
    std::transform(matrix, matrix + 6, m, [&](double x) { return x / scale; });
    a = {{{m[0], m[5], m[4]}, {m[5], m[1], m[3]}, {m[4], m[3], m[2]}}};
    diagonalise(a, v);
  }
  std::array<int, 3> order = {0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return a[i][i] > a[j][j]; });
  const bool finite = std::all_of(matrix, matrix + 6, [](double x) { return std::isfinite(x); });
  for (int k = 0; k < 3; ++k) {
    Vector vector = unit(v[order[k]]);
    const auto largest = std::max_element(vector.begin(), vector.end(), [](double x, double y) {
      return std::abs(x) < std::abs(y);
    });
    if (*largest < 0.0) vector = scaled(vector, -1.0);
    values[k] = finite ? a[order[k]][order[k]] * scale : NAN;
    std::copy(vector.begin(), vector.end(), vectors[k]);
  }
}

void polar_by_singular_values(const double* f, double* r) {
  const double scale = power_of_two_scale(f, 9);
  if (scale == 0.0) {
    const bool zero = std::all_of(f, f + 9, [](double x) { return x == 0.0; });
    for (int i = 0; i < 9; ++i) r[i] = !zero ? NAN : i % 4 == 0 ? 1.0 : 0.0;
    return;
  }
  Matrix b;  // row k is F v_k
  Matrix v = kIdentity;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) b[j][i] = f[3 * i + j] / scale;
  }
  orthogonalise(b, v);
  sort_descending(b, v);
  const double largest = std::sqrt(dot(b[0], b[0]));
  const Vector u1 = unit(b[0]), v1 = unit(v[0]);
  const Vector u2 = second_vector(b[1], u1, v1, v[1], largest), v2 = v[1];
  const Vector u3 = cross(u1, u2), v3 = cross(v1, v2);  // proper, whatever the sign of det F
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) r[3 * i + j] = u1[i] * v1[j] + u2[i] * v2[j] + u3[i] * v3[j];
  }
}

template <>
void run_builtin<Builtin::PolarRotation>(const BuiltinCall& call, double* out) {
  if (call.overload == 0) {
    polar_rotation3(call[0], out);
  } else {
    polar_rotation2(call[0], out);
  }
}
template <>
void run_builtin<Builtin::MaxEigenpair>(const BuiltinCall& call, double* out) {
  write_eigenpair(0, call, out);
}
template <>
void run_builtin<Builtin::MinEigenpair>(const BuiltinCall& call, double* out) {
  write_eigenpair(2, call, out);
}

}  // namespace gmsim::engine
