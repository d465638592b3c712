// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "support/integrator_settings.h"
#include "support/particle_world.h"

namespace gmsim {
namespace {

using tests::Oscillators;
using tests::ParticleWorld;
using tests::SpringChain;
using tests::springs;
using tests::with;

/// The messages of a world in which no simulation can be made.
std::string refused(const engine::IntegratorSettings& settings,
                    const std::function<void(ParticleWorld&)>& arrange = [](ParticleWorld&) {}) {
  ParticleWorld world(3, 0.1);
  arrange(world);
  CHECK_FALSE(world.simulate(springs(), settings));
  CHECK(world.diagnostics.error_count() == 1);
  return world.messages();
}

TEST_CASE("methods that do not exist are refused") {
  CHECK(refused(with("rk5", 1e-3)).find("unknown integrator method `rk5`") != std::string::npos);
  CHECK(refused(with("rk5", 1e-3)).find("did you mean `rk4`?") != std::string::npos);
  for (const char* const later :
       {"backward_euler", "bdf2", "newmark", "implicit_midpoint", "static", "auto"})
    CHECK(refused(with(later, 1e-3)).find("is not available") != std::string::npos);
}

TEST_CASE("settings that cannot be used are refused") {
  CHECK(refused(with("rk4", -1)).find("`dt` is -1") != std::string::npos);
  CHECK(refused(with("rk4", std::nan(""))).find("`dt` is nan") != std::string::npos);
  engine::IntegratorSettings settings = with("dormand_prince", 0);
  settings.rtol = 0;
  CHECK(refused(settings).find("`rtol` is 0") != std::string::npos);
  settings.rtol = 1e-6;
  settings.dt_min = 1;
  settings.dt_max = 0.1;
  CHECK(refused(settings).find("at least `dt_min`") != std::string::npos);
}

TEST_CASE("a free vertex without mass is refused, a fixed or prescribed one may have none") {
  for (const double mass : {0.0, -1.0, std::nan(""), 1e-320})
    CHECK(refused(with("rk4", 1e-3), [&](ParticleWorld& world) {
            world.weigh(1, mass);
          }).find("vertex (0.5, 0, 0)") != std::string::npos);
  ParticleWorld world(3, 0.1);
  world.weigh(0, 0);
  world.fix(0);
  world.weigh(2, 0);
  engine::Model model;
  model.motions.push_back(world.moved({2}, "(0, 0, 1)", false));
  CHECK(world.simulate(springs(), with("rk4", 1e-3), model));
}

TEST_CASE("fixed vertices do not move, whatever their velocity was") {
  for (const std::string method : {"symplectic_euler", "velocity_verlet", "rk4", "dormand_prince"}) {
    ParticleWorld world(3, 0.1);
    world.fix(0);
    world.throw_at(0, {1, 2, 3});
    const auto simulation = world.simulate(springs(), with(method, 1e-3));
    REQUIRE(simulation);
    world.run(*simulation, 0.2);
    CHECK(world.position(0) == std::array<double, 3>{0, 0, 0});
    CHECK(world.velocity(0) == std::array<double, 3>{0, 0, 0});
    CHECK(world.position(2)[2] < -0.1);
  }
}

TEST_CASE("evaluations: what is known at the end of a step starts the next") {
  struct Row {
    std::string method;
    std::uint32_t undamped, damped;
  };
  for (const Row& row : {Row{"symplectic_euler", 1, 1}, Row{"velocity_verlet", 1, 2},
                         Row{"rk4", 4, 4}, Row{"bogacki_shampine", 3, 3},
                         Row{"dormand_prince", 6, 6}})
    for (const double damping : {0.0, 0.02}) {
      ParticleWorld world(3, 0.1);
      const auto simulation = world.simulate(
          std::make_unique<SpringChain>(20, 0.5, damping, 0.1, 9.81), with(row.method, 1e-3));
      REQUIRE(simulation);
      const std::uint64_t start = simulation->evaluations();
      std::uint64_t counted = 0;
      for (int i = 0; i < 10; ++i) {
        const auto report = simulation->step(1, world.diagnostics);
        REQUIRE(report);
        CHECK(report->rejected == 0);
        CHECK(report->evaluations == (damping == 0 ? row.undamped : row.damped));
        counted += report->evaluations;
      }
      CHECK(simulation->evaluations() - start == counted);
      CHECK(start == 1);
    }
}

TEST_CASE("times are multiples of the step, and the last step ends where it must") {
  ParticleWorld world(2);
  const auto simulation = world.simulate(std::make_unique<Oscillators>(1, 0), with("rk4", 0.1));
  REQUIRE(simulation);
  for (int i = 1; i <= 1000; ++i) {
    const auto report = simulation->step(1e6, world.diagnostics);
    REQUIRE(report);
    CHECK(report->time == i * 0.1);
  }
  // A stop within a step shortens it; the next ones are whole again.
  REQUIRE(simulation->step(100.03, world.diagnostics));
  CHECK(simulation->time() == 100.03);
  REQUIRE(simulation->step(1e6, world.diagnostics));
  CHECK(simulation->time() == doctest::Approx(100.13).epsilon(1e-14));
  // A stop that is a step end but for rounding takes no extra step.
  ParticleWorld other(2);
  const auto again = other.simulate(std::make_unique<Oscillators>(1, 0), with("rk4", 0.1));
  while (again->time() < 0.3) REQUIRE(again->step(0.3, other.diagnostics));
  CHECK(again->time() == 0.3);
  CHECK(again->steps() == 3);
}

TEST_CASE("totals are sums over all particles") {
  ParticleWorld world(3, 2);
  world.throw_at(1, {0, 3, 0});
  const auto simulation = world.simulate(std::make_unique<Oscillators>(2, 0), with("rk4", 0.1));
  REQUIRE(simulation);
  const engine::Totals totals = simulation->totals();
  CHECK(totals.mass == doctest::Approx(6));
  CHECK(totals.kinetic == doctest::Approx(9));
  CHECK(totals.potential == doctest::Approx(0.5 * 4 * (0.25 + 1)));
  CHECK(totals.momentum[1] == doctest::Approx(6));
  CHECK(totals.angular_momentum[2] == doctest::Approx(0.5 * 6));
  CHECK(simulation->max_elongation() == doctest::Approx(1));
}

TEST_CASE("internal forces keep momentum and angular momentum") {
  for (const std::string method : {"symplectic_euler", "velocity_verlet", "rk4"}) {
    ParticleWorld world(6, 0.1);
    for (std::uint32_t k = 0; k < 6; ++k) world.throw_at(k, {0.3 * k, std::sin(k), -0.2});
    const auto simulation =
        world.simulate(std::make_unique<SpringChain>(20, 0.2, 0.02, 0.1), with(method, 1e-3));
    REQUIRE(simulation);
    const engine::Totals before = simulation->totals();
    world.run(*simulation, 2);
    const engine::Totals after = simulation->totals();
    for (std::size_t c = 0; c < 3; ++c) {
      CHECK(std::abs(after.momentum[c] - before.momentum[c]) < 1e-13);
      // RK4 keeps quadratic forms to its order only.
      CHECK(std::abs(after.angular_momentum[c] - before.angular_momentum[c]) <
            (method == "rk4" ? 1e-9 : method == "velocity_verlet" ? 1e-5 : 1e-13));
    }
  }
}

TEST_CASE("the same run gives the same bits; a restart goes on as if nothing had happened") {
  for (const std::string method : {"symplectic_euler", "velocity_verlet", "rk4"}) {
    const auto whole = [&](double until, double then) {
      ParticleWorld world(4, 0.1);
      world.fix(0);
      auto simulation = world.simulate(springs(), with(method, 1e-3));
      REQUIRE(simulation);
      world.run(*simulation, until);
      if (then > until) {
        simulation = world.simulate(springs(), with(method, 1e-3));
        REQUIRE(simulation);
        world.run(*simulation, then);
      }
      return simulation->state_hash();
    };
    CHECK(whole(0.7, 0) == whole(0.7, 0));
    CHECK(whole(0.35, 0.7) == whole(0.7, 0));
    CHECK(whole(0.35, 0) != whole(0.7, 0));
  }
}

TEST_CASE("a refreshed simulation goes on from the state it is given") {
  ParticleWorld world(3, 0.1);
  const auto simulation = world.simulate(springs(), with("rk4", 1e-3));
  REQUIRE(simulation);
  world.run(*simulation, 0.1);
  world.place(1, {0.4, 0, 0});
  world.fix(2);
  world.weigh(1, 0.3);
  REQUIRE(simulation->refresh(world.diagnostics));
  CHECK(simulation->totals().mass == doctest::Approx(0.5));
  const std::array<double, 3> held = world.position(2);
  world.run(*simulation, 0.2);
  CHECK(world.position(2) == held);
}

TEST_CASE("the plan names what a reader wants to know") {
  ParticleWorld world(3, 0.1);
  world.fix(0);
  const auto simulation = world.simulate(springs(), with("velocity_verlet", 1e-3));
  REQUIRE(simulation);
  const std::string text = simulation->explain();
  CHECK(text.find("integrator velocity_verlet: order 2, 2 evaluations") == 0);
  CHECK(text.find("vertices: 3, of them 1 fixed and 0 moved by decree") != std::string::npos);
  CHECK(text.find("hand-written forces") != std::string::npos);
}

}  // namespace
}  // namespace gmsim
