// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "engine/integrators/integrator.h"
#include "engine/integrators/test_equation.h"
#include "support/integrator_settings.h"
#include "support/particle_world.h"

namespace gmsim {
namespace {

using engine::find_integrator;
using engine::make_integrator;
using tests::Oscillators;
using tests::ParticleWorld;
using tests::SpringChain;
using tests::VertexRecord;
using tests::with_warning;

constexpr double kZ[] = {0.1, 0.5, 1.0, 1.9, 2.1, 2.8, 2.9};

/// Spectral radii of the one-step matrices, computed by other means with 60 digits.
struct KnownGrowth {
  std::string method;
  double zeta;
  std::array<double, 7> values;  // at kZ
};
const KnownGrowth kKnown[] = {
    {"symplectic_euler", 0, {1, 1, 1, 1, 1.877328044930449, 5.663428511917159, 6.25}},
    {"symplectic_euler",
     0.1,
     {0.9899494936611665, 0.948683298050514, 0.894427190999916, 1.6032968025561205,
      2.6075707526180576, 6.330495168499705, 6.929388591874833}},
    {"velocity_verlet", 0, {1, 1, 1, 1, 1.8773280449304495, 5.663428511917157, 6.25}},
    {"rk4",
     0,
     {0.9999999930642363, 0.9998948783722912, 0.993905036823047, 0.8008985648185871,
      0.6822395025987941, 0.9306672779367614, 1.1930626741549697}},
    {"rk4",
     0.1,
     {0.9900498675098391, 0.9512515113964487, 0.9022333401066489, 0.662197819881831,
      0.5202383493709878, 0.5849417064973218, 0.8512091113629837}},
};

TEST_CASE("growth per step of the test equation") {
  for (const KnownGrowth& known : kKnown) {
    const auto method = make_integrator(*find_integrator(known.method));
    for (std::size_t i = 0; i < std::size(kZ); ++i)
      CHECK_MESSAGE(method->growth(kZ[i], known.zeta) ==
                        doctest::Approx(known.values[i]).epsilon(1e-12),
                    known.method, " zeta ", known.zeta, " z ", kZ[i]);
  }
}

/// One step of the method itself on an oscillator of frequency 1 from (x, v).
std::pair<double, double> one_step(const std::string& name, double z, double zeta, double x,
                                   double v) {
  Oscillators forces(1, zeta);
  engine::PrescribedMotions nothing;
  engine::EquationsOfMotion equations(forces, nothing);
  equations.set_inverse_mass({1});
  const auto method = make_integrator(*find_integrator(name));
  method->resize(1);
  engine::PhasePoint now, next;
  now.resize(1);
  next.resize(1);
  now.motion.position[0] = {x, 0, 0};
  now.motion.velocity[0] = {v, 0, 0};
  REQUIRE(equations.evaluate(now.motion, 0, z, now.force, engine::Stage::End));
  REQUIRE(method->advance(equations, now, z, next));
  return {next.motion.position[0].x, next.motion.velocity[0].x};
}

TEST_CASE("the stated growth is that of the code, for every method") {
  for (const engine::IntegratorInfo& info : engine::integrators()) {
    const auto method = make_integrator(info);
    for (const double z : kZ)
      for (const double zeta : {0.0, 0.1, 0.7, 1.0, 2.5}) {
        const auto [xx, vx] = one_step(std::string(info.name), z, zeta, 1, 0);
        const auto [xv, vv] = one_step(std::string(info.name), z, zeta, 0, 1);
        const double growth = engine::spectral_radius({xx, xv, vx, vv});
        CHECK_MESSAGE(method->growth(z, zeta) == doctest::Approx(growth).epsilon(1e-6), info.name,
                      " z ", z, " zeta ", zeta);
      }
  }
}

TEST_CASE("growth over a thousand steps of a run") {
  // Amplitudes are measured in a norm in which an undamped mode turns: x^2 + v^2 for methods that
  // are normal there, so RK4; a thousand steps of the energy factor 1 - z^6/72 + z^8/576.
  for (const double z : {0.1, 0.5, 1.0}) {
    ParticleWorld world(2);
    world.place(0, {1, 0, 0});
    world.place(1, {0, 1, 0});
    const auto simulation =
        world.simulate(std::make_unique<Oscillators>(1, 0), with_warning("rk4", z));
    REQUIRE(simulation);
    const double before = simulation->totals().kinetic + simulation->totals().potential;
    for (int i = 0; i < 1000; ++i) REQUIRE(simulation->step(1e9, world.diagnostics));
    const double after = simulation->totals().kinetic + simulation->totals().potential;
    const double factor = 1 - std::pow(z, 6) / 72 + std::pow(z, 8) / 576;
    CHECK(std::pow(after / before, 1e-3) == doctest::Approx(factor).epsilon(1e-10));
  }
}

TEST_CASE("what symplectic methods conserve over a million steps") {
  const double z = 0.1;
  const auto drift = [&](const char* method, const auto& form) {
    ParticleWorld world(2);
    world.place(0, {1, 0, 0});
    world.place(1, {0, 0, 0});
    const auto simulation =
        world.simulate(std::make_unique<Oscillators>(1, 0), with_warning(method, z));
    REQUIRE(simulation);
    double worst = 0;
    for (int i = 0; i < 1000000; ++i) {
      REQUIRE(simulation->step(1e9, world.diagnostics));
      if (i % 1000 != 999) continue;
      simulation->sync();
      worst = std::max(worst, std::abs(form(world.position(0)[0], world.velocity(0)[0]) - 1));
    }
    return worst;
  };
  CHECK(drift("velocity_verlet", [&](double x, double v) {
          return (v * v + (1 - z * z / 4) * x * x) / (1 - z * z / 4);
        }) < 1e-9);
  CHECK(drift("symplectic_euler",
              [&](double x, double v) { return x * x + v * v - z * x * v; }) < 1e-9);
}

/// Largest error after 1 s of a chain that swings, stretches and is damped.
double chain_error(const std::string& method, double dt, double damping) {
  const auto end = [&](const std::string& name, double step) {
    ParticleWorld world(5, 0.1);
    world.fix(0);
    const auto simulation = world.simulate(
        std::make_unique<SpringChain>(20, 0.25, damping, 0.1, 9.81), with_warning(name, step));
    REQUIRE(simulation);
    world.run(*simulation, 1);
    std::vector<double> x;
    for (std::uint32_t k = 0; k < 5; ++k)
      for (const double c : world.position(k)) x.push_back(c);
    return x;
  };
  static std::vector<std::pair<double, std::vector<double>>> references;
  auto known = std::ranges::find(references, damping, &std::pair<double, std::vector<double>>::first);
  if (known == references.end()) {
    references.emplace_back(damping, end("rk4", 1e-4));
    known = references.end() - 1;
  }
  const std::vector<double> x = end(method, dt);
  double worst = 0;
  for (std::size_t i = 0; i < x.size(); ++i) worst = std::max(worst, std::abs(x[i] - known->second[i]));
  return worst;
}

TEST_CASE("observed orders, without and with damping") {
  struct Row {
    std::string method;
    double order, dt;
  };
  for (const Row& row : {Row{"symplectic_euler", 1, 1e-3}, Row{"velocity_verlet", 2, 2e-3},
                         Row{"rk4", 4, 4e-3}})
    for (const double damping : {0.0, 0.2}) {
      const double order = std::log2(chain_error(row.method, row.dt, damping) /
                                     chain_error(row.method, row.dt / 2, damping));
      CHECK_MESSAGE(std::abs(order - row.order) < 0.1, row.method, " damping ", damping, " order ",
                    order);
    }
}

/// The same with tolerance `rtol` for every error, and what it cost.
struct AdaptiveRun {
  double error = 0;
  std::uint64_t steps = 0, rejected = 0, evaluations = 0;
};
AdaptiveRun adaptive_run(const std::string& method, double rtol) {
  ParticleWorld world(5, 0.1);
  world.fix(0);
  engine::IntegratorSettings settings;
  settings.method = method;
  settings.rtol = rtol;
  const auto simulation =
      world.simulate(std::make_unique<SpringChain>(20, 0.25, 0.05, 0.1, 9.81), settings);
  REQUIRE(simulation);
  AdaptiveRun run;
  while (simulation->time() < 1) {
    const auto report = simulation->step(1, world.diagnostics);
    REQUIRE_MESSAGE(report.has_value(), world.messages());
    run.rejected += report->rejected;
  }
  simulation->sync();
  run.steps = simulation->steps();
  run.evaluations = simulation->evaluations();
  static const std::vector<double> reference = [] {
    ParticleWorld exact(5, 0.1);
    exact.fix(0);
    const auto rk4 = exact.simulate(std::make_unique<SpringChain>(20, 0.25, 0.05, 0.1, 9.81),
                                    with_warning("rk4", 5e-5));
    exact.run(*rk4, 1);
    std::vector<double> x;
    for (std::uint32_t k = 0; k < 5; ++k)
      for (const double c : exact.position(k)) x.push_back(c);
    return x;
  }();
  for (std::uint32_t k = 0; k < 5; ++k)
    for (std::size_t c = 0; c < 3; ++c)
      run.error = std::max(run.error, std::abs(world.position(k)[c] - reference[3 * k + c]));
  return run;
}

TEST_CASE("errors follow the tolerance, and few steps are rejected") {
  for (const char* const method : {"bogacki_shampine", "dormand_prince"}) {
    const bool fine = std::string(method) == "dormand_prince";
    const double loose = fine ? 1e-5 : 1e-4, tight = loose * 1e-4;
    const AdaptiveRun first = adaptive_run(method, loose), last = adaptive_run(method, tight);
    const double slope = std::log10(first.error / last.error) / 4;
    CHECK_MESSAGE((slope > 0.75 && slope < 1.25), method, " slope ", slope, " errors ", first.error,
                  " ", last.error);
    CHECK_MESSAGE(last.rejected * 5 < last.steps, method, " ", last.rejected, " of ", last.steps);
  }
}

TEST_CASE("dense output is as good as the steps") {
  ParticleWorld world(3, 0.1);
  world.fix(0);
  engine::IntegratorSettings settings;
  settings.method = "dormand_prince";
  settings.rtol = 1e-8;
  const auto make = [] { return std::make_unique<SpringChain>(20, 0.5, 0, 0.1, 9.81); };
  const auto simulation = world.simulate(make(), settings);
  REQUIRE(simulation);
  double worst = 0;
  for (int frame = 1; frame <= 10; ++frame) {
    const double time = 0.03 * frame;
    while (simulation->time() < time) REQUIRE(simulation->step(1, world.diagnostics));
    std::vector<double> dense;
    simulation->dense_positions(time, dense);
    ParticleWorld exact(3, 0.1);
    exact.fix(0);
    const auto rk4 = exact.simulate(make(), with_warning("rk4", 1e-4));
    exact.run(*rk4, time);
    for (std::uint32_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < 3; ++c)
        worst = std::max(worst, std::abs(dense[3 * k + c] - exact.position(k)[c]));
  }
  CHECK(worst < 1e-7);
}

TEST_CASE("adaptive steps end where they are told to") {
  ParticleWorld world(3, 0.1);
  engine::IntegratorSettings settings;
  settings.method = "dormand_prince";
  const auto simulation = world.simulate(std::make_unique<Oscillators>(5, 0), settings);
  REQUIRE(simulation);
  for (const double stop : {0.1, 0.1 + 1e-7, 1.0 / 3, 2.0}) {
    while (simulation->time() < stop) REQUIRE(simulation->step(stop, world.diagnostics));
    CHECK(simulation->time() == stop);
  }
}

}  // namespace
}  // namespace gmsim
