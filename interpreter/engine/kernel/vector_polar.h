// SPDX-License-Identifier: MIT
// Rotations closest to matrices. Included after vector.h.

/// The largest power of two not above any of 1 … the largest entry; its inverse is exact.
GMSIM_INLINE V inverse_scale(const Pack<9>& f) {
  V largest = abs(f.c[0]);
  for (int k = 1; k < 9; ++k) largest = select(abs(f.c[k]) > largest, abs(f.c[k]), largest);
  return 1.0 / V(Bits(largest) & Bits(broadcast(__builtin_inf())));
}

/// One step of Newton's method towards the rotation of X = R S: (X + X^-T) / 2 (Higham 1986), with
/// the determinant of X.
struct PolarStep {
  Pack<9> x;
  V determinant;
};
GMSIM_INLINE PolarStep polar_step(const Pack<9>& x) {
  const V* c = x.c;
  const Pack<9> cofactors = {
      {c[4] * c[8] - c[5] * c[7], c[5] * c[6] - c[3] * c[8], c[3] * c[7] - c[4] * c[6],
       c[7] * c[2] - c[8] * c[1], c[8] * c[0] - c[6] * c[2], c[6] * c[1] - c[7] * c[0],
       c[1] * c[5] - c[2] * c[4], c[2] * c[3] - c[0] * c[5], c[0] * c[4] - c[1] * c[3]}};
  PolarStep step;
  step.determinant = c[0] * cofactors.c[0] + c[1] * cofactors.c[1] + c[2] * cofactors.c[2];
  const V half = 0.5 / step.determinant;
  for (int k = 0; k < 9; ++k) step.x.c[k] = 0.5 * c[k] + half * cofactors.c[k];
  return step;
}

/// The rotation of F = R S. Matrices that are nearly singular, turned inside out or not finite are
/// left to the method that can do them, lane by lane. What a lane gives depends on that lane only.
static Pack<9> polar_rotation(const Pack<9>& f) {
  constexpr int kMostSteps = 16;
  const V scale = inverse_scale(f);
  Pack<9> x;
  for (int k = 0; k < 9; ++k) x.c[k] = f.c[k] * scale;
  PolarStep step = polar_step(x);
  const M regular = step.determinant > 0.1;  // entries are below 2
  M active = regular;
  for (int count = 0; count < kMostSteps && any(active); ++count) {
    if (count > 0) step = polar_step(x);
    V change = {};
    for (int k = 0; k < 9; ++k) {
      const V difference = step.x.c[k] - x.c[k];
      change += difference * difference;
      x.c[k] = select(active, step.x.c[k], x.c[k]);
    }
    active = active & (change > 1e-16);  // half its square is the error that remains
  }
  const M left = ~regular | active;
  if (__builtin_expect(any(left), 0)) {
    for (std::size_t lane = 0; lane < kWidth; ++lane) {
      if (!left[lane]) continue;
      double from[9], to[9];
      for (int k = 0; k < 9; ++k) from[k] = f.c[k][lane];
      polar_by_singular_values(from, to);
      for (int k = 0; k < 9; ++k) x.c[k][lane] = to[k];
    }
  }
  return x;
}
