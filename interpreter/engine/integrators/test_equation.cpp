// SPDX-License-Identifier: MIT
#include "engine/integrators/test_equation.h"

#include <algorithm>
#include <cmath>

namespace gmsim::engine {

double spectral_radius(const StepMatrix& m) {
  const double half_trace = 0.5 * (m.xx + m.vv);
  const double determinant = m.xx * m.vv - m.xv * m.vx;
  // ((xx - vv) / 2)^2 + xv vx, which is half_trace^2 - determinant without its cancellation.
  const double half_difference = 0.5 * (m.xx - m.vv);
  const double discriminant = half_difference * half_difference + m.xv * m.vx;
  if (discriminant < 0) return std::sqrt(determinant);
  return std::abs(half_trace) + std::sqrt(discriminant);
}

double polynomial_growth(std::span<const double> coefficients, double z, double zeta) {
  const std::complex<double> root = std::sqrt(std::complex<double>(zeta * zeta - 1, 0));
  double growth = 0;
  for (const double sign : {1.0, -1.0}) {
    const std::complex<double> at = z * (-zeta + sign * root);
    std::complex<double> value = 0;
    for (std::size_t k = coefficients.size(); k-- > 0;) value = value * at + coefficients[k];
    growth = std::max(growth, std::abs(value));
  }
  return growth;
}

}  // namespace gmsim::engine
