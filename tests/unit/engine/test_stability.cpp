// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "engine/integrators/integrator.h"
#include "engine/stability.h"
#include "engine/stability_lanczos.h"
#include "support/particle_world.h"

namespace gmsim {
namespace {

using engine::find_integrator;
using engine::make_integrator;
using engine::OnUnstable;
using tests::Oscillators;
using tests::ParticleWorld;
using tests::SpringChain;
using tests::VertexRecord;

TEST_CASE("limits of single modes") {
  struct Row {
    std::string method;
    std::array<double, 5> limits;  // omega dt at zeta = 0, 0.1, 0.5, 1, 2
  };
  const Row rows[] = {
      {"symplectic_euler", {2, 1.809975124224268, 1.236067977500066, 0.8284271247464831,
                            0.4721359549997906}},
      {"rk4", {2.8284271247465878, 2.9508529575264557, 2.6225424918313185, 2.7852935522292728,
               0.746317160998227}},
      // A single correction of the velocity: from the 2x2 matrix, by bisection elsewhere.
      {"velocity_verlet", {2, 1.8431, 2, 1, 0.5}},
  };
  const double zetas[] = {0, 0.1, 0.5, 1, 2};
  for (const Row& row : rows) {
    const auto method = make_integrator(*find_integrator(row.method));
    for (std::size_t i = 0; i < 5; ++i) {
      const double omega = 40;
      const double z = omega * engine::step_limit(*method, omega, 2 * zetas[i] * omega);
      CHECK_MESSAGE(z == doctest::Approx(row.limits[i]).epsilon(1e-3), row.method, " zeta ",
                    zetas[i]);
    }
  }
  const auto rk4 = make_integrator(*find_integrator("rk4"));
  CHECK(engine::step_limit(*rk4, 0, 3) * 3 == doctest::Approx(2.7852935).epsilon(1e-5));
  CHECK(std::isinf(engine::step_limit(*rk4, 0, 0)));
  // Any damping up to 2 omega: the worst is at zeta = 0.55, or where there is no stiffness.
  CHECK(engine::step_limit_within(*rk4, 1, 2) <= 2.7853 / 2 * (1 + 1e-3));
  CHECK(engine::step_limit_within(*rk4, 1, 0.1) == doctest::Approx(2.8284).epsilon(1e-3));
}

/// Does an oscillator at z = omega dt stay bounded over many steps of a run?
bool stays(const std::string& method, double z, double zeta) {
  ParticleWorld world(2);
  world.fix(1);
  world.place(0, {1e-6, 5e-7, 0});  // far below the length of the edge, so that growth is no blow-up yet
  auto forces = std::make_unique<Oscillators>(1, zeta);
  engine::IntegratorSettings settings;
  settings.method = method;
  settings.dt = z;
  settings.on_unstable = OnUnstable::Warn;
  const auto simulation = world.simulate(std::move(forces), settings);
  REQUIRE(simulation);
  for (int i = 0; i < 3000; ++i)
    if (!simulation->step(1e9, world.diagnostics)) return false;
  simulation->sync();
  return std::abs(world.position(0)[0]) < 1e-5;
}

TEST_CASE("measured limits of runs are within a percent of the stated ones, and the report of a "
          "simulation is not above them") {
  for (const std::string method : {"symplectic_euler", "velocity_verlet", "rk4"})
    for (const double zeta : {0.0, 0.1, 0.5, 1.0, 2.0}) {
      const auto code = make_integrator(*find_integrator(method));
      const double limit = engine::step_limit(*code, 1, 2 * zeta);
      CHECK_MESSAGE(stays(method, 0.99 * limit, zeta), method, " zeta ", zeta);
      CHECK_MESSAGE(!stays(method, 1.01 * limit, zeta), method, " zeta ", zeta);

      ParticleWorld world(2);
      engine::IntegratorSettings settings;
      settings.method = method;
      settings.dt = 0.1;
      const auto simulation = world.simulate(std::make_unique<Oscillators>(1, zeta), settings);
      REQUIRE(simulation);
      CHECK_MESSAGE(simulation->limit().dt_global <= limit * (1 + 1e-9), method, " zeta ", zeta);
      CHECK_MESSAGE(simulation->limit().dt_global >= 0.9 * limit, method, " zeta ", zeta);
      CHECK(simulation->limit().dt <= simulation->limit().dt_global);
      CHECK(simulation->limit().damping_ratio == doctest::Approx(zeta).epsilon(0.02));
    }
}

TEST_CASE("Lanczos finds both ends of a spectrum") {
  // The chain with fixed ends: 2 - 2 cos(k pi / (n + 1)).
  for (const std::size_t n : {1u, 2u, 7u, 60u, 400u}) {
    const auto apply = [&](std::span<const VertexRecord> in, std::span<VertexRecord> out) {
      for (std::size_t r = 0; r < n; ++r) {
        const VertexRecord left = r > 0 ? in[r - 1] : VertexRecord{};
        const VertexRecord right = r + 1 < n ? in[r + 1] : VertexRecord{};
        out[r] = {2 * in[r].x - left.x - right.x, 2 * in[r].y - left.y - right.y,
                  2 * in[r].z - left.z - right.z, 0};
      }
      return true;
    };
    const std::vector<double> free(n, 1.0);
    const engine::SpectrumEnds ends = engine::spectrum_ends(apply, free, 120);
    REQUIRE(ends.known);
    const double angle = std::acos(-1.0) / (static_cast<double>(n) + 1);
    const double largest = 2 + 2 * std::cos(angle);
    CHECK_MESSAGE(ends.largest <= largest * (1 + 1e-12), n);
    CHECK_MESSAGE(ends.largest >= largest * 0.995, n);
    CHECK(engine::rayleigh_quotient(apply, ends.top) == doctest::Approx(ends.largest).epsilon(1e-3));
    CHECK(engine::rayleigh_quotient(apply, ends.bottom) ==
          doctest::Approx(ends.smallest).epsilon(1e-2));
    CHECK(ends.products <= 122);
  }
  const std::vector<double> nothing(3, 0.0);
  CHECK_FALSE(engine::spectrum_ends([](auto, auto) { return true; }, nothing, 10).known);
}

TEST_CASE("the limit of a chain, at rest and stretched") {
  const auto limit_of = [](double stretch) {
    ParticleWorld world(21, 0.5, stretch);
    world.fix(0);
    world.fix(20);
    engine::IntegratorSettings settings;
    settings.dt = 1e-4;
    const auto simulation =
        world.simulate(std::make_unique<SpringChain>(300, 1. / 20, 0, 0.5), settings);
    REQUIRE(simulation);
    return simulation->limit();
  };
  // Free particles 19, ends fixed.
  const double exact = std::sqrt(300 / 0.5 * (2 + 2 * std::cos(std::acos(-1.0) / 20)));
  const engine::StabilityLimit rest = limit_of(1);
  CHECK(rest.omega_global >= exact);
  CHECK(rest.omega_global <= 1.02 * exact);
  CHECK(rest.omega_bound == doctest::Approx(std::sqrt(4 * 300 / 0.5)));
  CHECK(rest.dt_global == doctest::Approx(2.8284 / rest.omega_global).epsilon(1e-3));
  CHECK(limit_of(2).omega_global >= exact);
}

TEST_CASE("a look at torn vertices sees what is stiffer than the stiffest mode") {
  constexpr std::size_t kParticles = 21;
  SpringChain forces(300, 1. / 20, 0, 0.5);
  const auto method = make_integrator(*find_integrator("rk4"));
  engine::StabilityEstimator estimator(forces, *method);
  engine::PhasePoint point;
  point.resize(kParticles);
  for (std::size_t r = 0; r < kParticles; ++r) point.motion.position[r].x = static_cast<double>(r) / 20;
  std::vector<double> inverse(kParticles, 1 / 0.5);
  engine::StabilityLimit limit;
  CHECK(estimator.has_stiffened_at(std::array<gmap::Row, 1>{3}, point, inverse));  // nothing is known
  REQUIRE(estimator.estimate(point, inverse, limit));
  const std::array<gmap::Row, 2> torn{9, 10};
  CHECK_FALSE(estimator.has_stiffened_at(torn, point, inverse));
  // A part with a quarter of the mass, between the same two springs: 2 k / m is twice as much as
  // the 4 k / m of the chain.
  inverse[10] *= 4;
  CHECK(estimator.has_stiffened_at(torn, point, inverse));
  // A look goes as many vertices far as it takes products.
  CHECK_FALSE(estimator.has_stiffened_at(std::array<gmap::Row, 1>{0}, point, inverse));
  // Half of it is about as stiff as the chain, not stiffer by 2 % in the modes of one vertex.
  inverse[10] = 1 / 0.5;
  inverse[3] *= 1.01;
  CHECK_FALSE(estimator.has_stiffened_at(std::array<gmap::Row, 1>{3}, point, inverse));
  // A held vertex has no mode.
  inverse[3] = 0;
  CHECK_FALSE(estimator.has_stiffened_at(std::array<gmap::Row, 1>{3}, point, inverse));
}

engine::IntegratorSettings rk4(double dt, OnUnstable policy) {
  engine::IntegratorSettings settings;
  settings.dt = dt;
  settings.on_unstable = policy;
  return settings;
}

TEST_CASE("what happens above the limit") {
  // omega = 1 by both estimates: Lanczos adds half a percent to it.
  const auto make = [] { return std::make_unique<Oscillators>(1, 0); };
  const double limit = 2.8284;
  {
    ParticleWorld world(2);
    CHECK(world.simulate(make(), rk4(0.97 * limit, OnUnstable::Error)));
    CHECK_FALSE(world.diagnostics.has_errors());
  }
  {
    ParticleWorld world(2);
    CHECK_FALSE(world.simulate(make(), rk4(1.03 * limit, OnUnstable::Error)));
    REQUIRE(world.diagnostics.all().size() == 1);
    const support::Diagnostic& problem = world.diagnostics.all()[0];
    CHECK(problem.kind == support::DiagnosticKind::Unstable);
    CHECK(problem.message.find("time step 2.91325 s is 1.035 times the stability limit") == 0);
    CHECK(problem.message.find("`rk4`") != std::string::npos);
    CHECK(problem.help.find("on_unstable: substep") != std::string::npos);
  }
  {
    ParticleWorld world(2);
    const auto simulation = world.simulate(make(), rk4(1.03 * limit, OnUnstable::Warn));
    REQUIRE(simulation);
    REQUIRE(world.diagnostics.all().size() == 1);
    CHECK(world.diagnostics.all()[0].severity == support::Severity::Warning);
  }
  {
    ParticleWorld world(2);
    world.place(0, {1, 0, 0});
    const auto simulation = world.simulate(make(), rk4(10, OnUnstable::Substep));
    REQUIRE(simulation);
    CHECK(world.diagnostics.all().empty());
    for (int i = 0; i < 100; ++i) {
      const auto report = simulation->step(1e9, world.diagnostics);
      REQUIRE(report);
      CHECK(report->evaluations == 4 * 4);  // 10 s are four steps of 2.5 s
    }
    CHECK(simulation->time() == 1000);
    CHECK(simulation->totals().kinetic + simulation->totals().potential <= 1);
  }
}

TEST_CASE("between the bound and the global limit there is a warning") {
  ParticleWorld world(2);
  auto forces = std::make_unique<Oscillators>(1, 0);
  forces->bound.stiffness = 4;  // elements alone are twice as fast
  forces->bound.where = world.dart(1);
  const auto simulation = world.simulate(std::move(forces), rk4(2, OnUnstable::Error));
  REQUIRE(simulation);
  CHECK(simulation->limit().dt == doctest::Approx(1.4142).epsilon(1e-3));
  REQUIRE(world.diagnostics.all().size() == 1);
  const support::Diagnostic& warning = world.diagnostics.all()[0];
  CHECK(warning.severity == support::Severity::Warning);
  CHECK(warning.message.find("element-wise") != std::string::npos);
  REQUIRE(warning.notes.size() == 2);
  CHECK(warning.notes[1].find("vertex (1, 0, 0)") != std::string::npos);
}

TEST_CASE("an element bound that is infinite leaves the global limit") {
  ParticleWorld world(2);
  auto forces = std::make_unique<Oscillators>(1, 0);
  forces->bound.stiffness = std::numeric_limits<double>::infinity();
  const auto simulation = world.simulate(std::move(forces), rk4(2, OnUnstable::Error));
  REQUIRE(simulation);
  CHECK(world.diagnostics.all().empty());
  CHECK(simulation->limit().dt == simulation->limit().dt_global);
}

TEST_CASE("dt: auto is a fixed part of the element-wise limit") {
  ParticleWorld world(2);
  auto forces = std::make_unique<Oscillators>(1, 0);
  forces->bound.stiffness = 4;
  const auto simulation = world.simulate(std::move(forces), rk4(0, OnUnstable::Error));
  REQUIRE(simulation);
  CHECK(simulation->dt() == doctest::Approx(0.9 * 1.41421).epsilon(1e-4));

  ParticleWorld loose(2);
  CHECK_FALSE(loose.simulate(std::make_unique<tests::ForcesOf>([](auto&&...) {
                               return VertexRecord{0, 0, -9.81};
                             }),
                             rk4(0, OnUnstable::Error)));
  CHECK(loose.messages().find("nothing limits the time step") != std::string::npos);
}

TEST_CASE("adaptive steps stay below the limit, and say that it held them") {
  ParticleWorld world(2);
  world.place(0, {1e-9, 0, 0});
  world.fix(1);
  engine::IntegratorSettings settings;
  settings.method = "bogacki_shampine";
  settings.rtol = 1e-3;
  settings.atol_position = 1e-3;
  settings.atol_velocity = 1e-3;
  const auto simulation = world.simulate(std::make_unique<Oscillators>(1, 0.2), settings);
  REQUIRE(simulation);
  const double cap = 0.9 * simulation->limit().dt_global;
  int held = 0;
  for (int i = 0; i < 50; ++i) {
    const auto report = simulation->step(1e9, world.diagnostics);
    REQUIRE(report);
    CHECK(report->dt <= cap * (1 + 1e-9));
    held += report->at_stability_limit ? 1 : 0;
  }
  CHECK(held > 30);
}

}  // namespace
}  // namespace gmsim
