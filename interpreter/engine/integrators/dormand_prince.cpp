// SPDX-License-Identifier: MIT
#include "engine/integrators/methods.h"
#include "engine/integrators/runge_kutta.h"

namespace gmsim::engine {
namespace {

/// Dormand and Prince 1980: order 5 with an embedded method of order 4; the stage at the end of a
/// step is the first of the next.
struct DormandPrince {
  static constexpr std::size_t kStages = 6;
  static constexpr int kEmbeddedOrder = 4;
  static constexpr double kA[6][6] = {
      {},
      {1. / 5},
      {3. / 40, 9. / 40},
      {44. / 45, -56. / 15, 32. / 9},
      {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
      {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656}};
  static constexpr double kB[6] = {35. / 384,     0,         500. / 1113, 125. / 192,
                                   -2187. / 6784, 11. / 84};
  static constexpr double kC[6] = {0, 1. / 5, 3. / 10, 4. / 5, 8. / 9, 1};
  static constexpr double kE[7] = {71. / 57600,      0,         -71. / 16695, 71. / 1920,
                                   -17253. / 339200, 22. / 525, -1. / 40};
};

}  // namespace

std::unique_ptr<Integrator> make_dormand_prince() {
  return std::make_unique<RungeKutta<DormandPrince>>();
}

}  // namespace gmsim::engine
