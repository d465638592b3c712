// SPDX-License-Identifier: MIT
// Polar rotations and eigenvalues. Included inside the namespace of one instruction set.

static void polar(const Instruction& in, BlockFrame& f) {
  run<9, 9>(in, f, [](const Pack<9>& m) { return polar_rotation(m); });
}

/// Eigenvalues in descending order, and the vector of number `which`.
struct Eigenpair {
  V value;
  Pack<3> vector;
};
GMSIM_INLINE Eigenpair eigenpair(const Pack<6>& s, int which) {
  Eigenpair pair;
  for (std::size_t lane = 0; lane < kWidth; ++lane) {
    double from[6], values[3], vectors[3][3];
    for (int k = 0; k < 6; ++k) from[k] = s.c[k][lane];
    engine::eigen_symmetric3(from, values, vectors);
    pair.value[lane] = values[which];
    for (int k = 0; k < 3; ++k) pair.vector.c[k][lane] = vectors[which][k];
  }
  return pair;
}
template <int which>
static void eigenvalue(const Instruction& in, BlockFrame& f) {
  run<1, 6>(in, f, [](const Pack<6>& s) { return Pack<1>{{eigenpair(s, which).value}}; });
}
template <int which>
static void eigenvector(const Instruction& in, BlockFrame& f) {
  run<3, 6>(in, f, [](const Pack<6>& s) { return eigenpair(s, which).vector; });
}
