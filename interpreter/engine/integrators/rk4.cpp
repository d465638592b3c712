// SPDX-License-Identifier: MIT
#include "engine/integrators/methods.h"
#include "engine/integrators/runge_kutta.h"

namespace gmsim::engine {
namespace {

/// Kutta 1901.
struct Rk4 {
  static constexpr std::size_t kStages = 4;
  static constexpr int kEmbeddedOrder = 0;
  static constexpr double kA[4][4] = {{}, {0.5}, {0, 0.5}, {0, 0, 1}};
  static constexpr double kB[4] = {1. / 6, 1. / 3, 1. / 3, 1. / 6};
  static constexpr double kC[4] = {0, 0.5, 0.5, 1};
  static constexpr double kE[5] = {};
};

}  // namespace

std::unique_ptr<Integrator> make_rk4() { return std::make_unique<RungeKutta<Rk4>>(); }

}  // namespace gmsim::engine
