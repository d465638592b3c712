// SPDX-License-Identifier: MIT
#pragma once

#include <complex>
#include <span>

/// The scalar test equation x'' = -omega^2 x - 2 zeta omega x', on which growth per step and
/// stability limits of the methods are stated; z = omega dt.
namespace gmsim::engine {

/// The 2x2 matrix that takes (x, x'/omega) over one step, row by row.
struct StepMatrix {
  double xx = 0, xv = 0, vx = 0, vv = 0;
};
/// Largest absolute eigenvalue.
[[nodiscard]] double spectral_radius(const StepMatrix& matrix);

/// Growth of a Runge-Kutta method, max |R(z mu)| over both roots mu of mu^2 + 2 zeta mu + 1 = 0;
/// `coefficients` are those of the stability polynomial R, lowest first.
[[nodiscard]] double polynomial_growth(std::span<const double> coefficients, double z, double zeta);

}  // namespace gmsim::engine
