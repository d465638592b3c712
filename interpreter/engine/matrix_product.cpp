// SPDX-License-Identifier: MIT
#include "engine/matrix_product.h"

#include <algorithm>
#include <array>

namespace gmsim::engine {

using types::ValueKind;

namespace {

/// A matrix operand of a product, row-major; sym3 is written out.
struct MatrixOperand {
  MatrixOperand(ValueKind kind, const double* v) {
    switch (kind) {
      case ValueKind::Mat3:
        std::copy_n(v, 9, entries.begin());
        break;
      case ValueKind::Sym3:
        entries = {v[0], v[5], v[4], v[5], v[1], v[3], v[4], v[3], v[2]};
        break;
      default:
        rows = 2;
        std::copy_n(v, 4, entries.begin());
    }
  }
  int rows = 3;
  std::array<double, 9> entries{};
};

void matrix_times_vector(const MatrixOperand& a, const double* v, double* out) {
  for (int i = 0; i < a.rows; ++i) {
    double sum = a.entries[a.rows * i] * v[0];
    for (int k = 1; k < a.rows; ++k) sum += a.entries[a.rows * i + k] * v[k];
    out[i] = sum;
  }
}

void matrix_times_matrix(const MatrixOperand& a, const MatrixOperand& b, double* out) {
  const int n = a.rows;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      double sum = a.entries[n * i] * b.entries[j];
      for (int k = 1; k < n; ++k) sum += a.entries[n * i + k] * b.entries[n * k + j];
      out[n * i + j] = sum;
    }
  }
}

}  // namespace

void multiply(ValueKind left, const double* a, ValueKind right, const double* b, double* out) {
  const MatrixOperand matrix(left, a);
  if (right == ValueKind::Vec2 || right == ValueKind::Vec3)
    return matrix_times_vector(matrix, b, out);
  matrix_times_matrix(matrix, MatrixOperand(right, b), out);
}

}  // namespace gmsim::engine
