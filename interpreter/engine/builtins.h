// SPDX-License-Identifier: MIT
#pragma once

#include "types/builtin.h"

/// The code of the builtin functions of types/builtins.def, on plain numbers.
namespace gmsim::engine {

/// One call: components of the arguments, in the layout of types::component_count, and which
/// overload of the function's row in builtins.def is meant.
struct BuiltinCall {
  static constexpr int kMaxArguments = 3;
  const double* arguments[kMaxArguments] = {};
  int overload = 0;

  [[nodiscard]] const double* operator[](int i) const { return arguments[i]; }
};

/// Specialised in builtins_*.cpp for every row; a row without code does not link.
template <types::Builtin function>
void run_builtin(const BuiltinCall& call, double* out);

using BuiltinFunction = void (*)(const BuiltinCall&, double*);
[[nodiscard]] BuiltinFunction builtin_function(types::Builtin function);

/// x^y. Whole exponents up to 64 by repeated multiplication and halves by a square root, in an
/// order that does not depend on the machine.
[[nodiscard]] double power(double x, double y);

/// Eigenvalues (descending) and unit eigenvectors (rows of `vectors`) of a symmetric matrix given
/// as xx, yy, zz, yz, xz, xy. Cyclic Jacobi rotations on the matrix scaled by a power of two:
/// errors are of the order of the rounding of the largest entry. The largest component of each
/// vector is positive.
void eigen_symmetric3(const double* matrix, double values[3], double vectors[3][3]);

/// The proper rotation R closest to F (row-major): that of F = R S with, for det F < 0, the smallest
/// singular value counted negative. Rank one: the shortest rotation; zero: the identity.
void polar_rotation3(const double* f, double* r);

}  // namespace gmsim::engine
