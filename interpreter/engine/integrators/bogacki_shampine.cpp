// SPDX-License-Identifier: MIT
#include "engine/integrators/methods.h"
#include "engine/integrators/runge_kutta.h"

namespace gmsim::engine {
namespace {

/// Bogacki and Shampine 1989: order 3 with an embedded method of order 2; the stage at the end of a
/// step is the first of the next.
struct BogackiShampine {
  static constexpr std::size_t kStages = 3;
  static constexpr int kEmbeddedOrder = 2;
  static constexpr double kA[3][3] = {{}, {0.5}, {0, 0.75}};
  static constexpr double kB[3] = {2. / 9, 1. / 3, 4. / 9};
  static constexpr double kC[3] = {0, 0.5, 0.75};
  static constexpr double kE[4] = {2. / 9 - 7. / 24, 1. / 3 - 1. / 4, 4. / 9 - 1. / 3, -1. / 8};
};

}  // namespace

std::unique_ptr<Integrator> make_bogacki_shampine() {
  return std::make_unique<RungeKutta<BogackiShampine>>();
}

}  // namespace gmsim::engine
