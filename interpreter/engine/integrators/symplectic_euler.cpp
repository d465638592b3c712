// SPDX-License-Identifier: MIT
#include "engine/integrators/methods.h"
#include "engine/integrators/test_equation.h"
#include "engine/integrators/vertex_record_math.h"

namespace gmsim::engine {
namespace {

/// v' = v + h M^-1 f(x, v, t), then x' = x + h v'.
class SymplecticEuler final : public Integrator {
 public:
  void resize(std::size_t) override {}

  bool advance(EquationsOfMotion& equations, const PhasePoint& now, double dt,
               PhasePoint& next) override {
    const std::size_t rows = now.rows();
    const double* const inverse_mass = equations.inverse_mass().data();
    const VertexRecord* const x0 = now.motion.position.data();
    const VertexRecord* const v0 = now.motion.velocity.data();
    const VertexRecord* const force = now.force.data();
    VertexRecord* const x = next.motion.position.data();
    VertexRecord* const v = next.motion.velocity.data();
    equations.for_rows(rows, [=](std::size_t begin, std::size_t end) {
      for (std::size_t r = begin; r < end; ++r) {
        v[r] = v0[r] + dt * inverse_mass[r] * force[r];
        x[r] = x0[r] + dt * v[r];
      }
    });
    next.time = now.time + dt;
    return equations.evaluate(next.motion, next.time, dt, next.force, Stage::End);
  }

  double growth(double z, double zeta) const override {
    const double kept = 1 - 2 * zeta * z;  // of the velocity, before the force acts
    return spectral_radius({.xx = 1 - z * z, .xv = z * kept, .vx = -z, .vv = kept});
  }
};

}  // namespace

std::unique_ptr<Integrator> make_symplectic_euler() { return std::make_unique<SymplecticEuler>(); }

}  // namespace gmsim::engine
