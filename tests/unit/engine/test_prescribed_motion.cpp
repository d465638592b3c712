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
using tests::VertexRecord;
using tests::springs;
using tests::with;

TEST_CASE("position as a function of time, with its derivative as velocity") {
  for (const std::string method : {"symplectic_euler", "velocity_verlet", "rk4", "dormand_prince"}) {
    ParticleWorld world(3, 0.1);
    engine::Model model;
    model.motions.push_back(
        world.moved({0}, "(0.1 [m] * sin(3 [1/s] * time), position.y + 1 [m/s^2] * time * time, 0.2 [m])", true));
    const auto simulation = world.simulate(springs(), with(method, 1e-3), model);
    REQUIRE_MESSAGE(simulation, world.messages());
    for (int i = 0; i < 400; ++i) {
      REQUIRE(simulation->step(10, world.diagnostics));
      simulation->sync();
      const double t = simulation->time();
      CHECK(std::abs(world.position(0)[0] - 0.1 * std::sin(3 * t)) < 1e-15);
      CHECK(std::abs(world.position(0)[1] - t * t) < 1e-14);
      CHECK(world.position(0)[2] == 0.2);
      CHECK(std::abs(world.velocity(0)[0] - 0.3 * std::cos(3 * t)) < 1e-9);
      CHECK(std::abs(world.velocity(0)[1] - 2 * t) < 1e-9);
      CHECK(std::abs(world.velocity(0)[2]) < 1e-9);
    }
  }
}

TEST_CASE("velocity as a function of time, integrated from where the vertex is") {
  for (const std::string method : {"symplectic_euler", "velocity_verlet", "rk4", "dormand_prince"}) {
    ParticleWorld world(3, 0.1);
    engine::Model model;
    model.motions.push_back(world.moved({2, 0}, "(0, -0.1, cos(5 [1/s] * time))", false));
    const auto simulation = world.simulate(springs(), with(method, 2e-3), model);
    REQUIRE_MESSAGE(simulation, world.messages());
    world.run(*simulation, 1);
    for (const std::uint32_t k : {0u, 2u}) {
      CHECK(world.position(k)[0] == 0.5 * k);
      CHECK(std::abs(world.position(k)[1] + 0.1) < 1e-13);
      CHECK(std::abs(world.position(k)[2] - std::sin(5.0) / 5) < 1e-13);
      CHECK(std::abs(world.velocity(k)[2] - std::cos(5.0)) < 1e-14);
    }
  }
}

TEST_CASE("decree holds at every stage: the order of RK4 stays 4") {
  const auto end = [](double dt) {
    ParticleWorld world(3, 0.1);
    engine::Model model;
    model.motions.push_back(world.moved({0}, "(0.2 * sin(4 [1/s] * time), 0, 0)", true));
    const auto simulation = world.simulate(springs(), with("rk4", dt), model);
    REQUIRE(simulation);
    world.run(*simulation, 0.5);
    return world.position(2);
  };
  const auto exact = end(1e-4);
  const auto error = [&](double dt) {
    const auto x = end(dt);
    return std::hypot(x[0] - exact[0], x[1] - exact[1], x[2] - exact[2]);
  };
  const double order = std::log2(error(1e-2) / error(5e-3));
  CHECK_MESSAGE(std::abs(order - 4) < 0.25, order);
}

TEST_CASE("an expression reads what the vertex had at the start, whenever the state is synced") {
  // Turns about z by 0.7 rad/s, in terms of the position: the position at the start.
  const std::string turn =
      "(position.x * cos(0.7 [1/s] * time), position.x * sin(0.7 [1/s] * time), position.z)";
  const auto end = [&](bool sync_often) {
    ParticleWorld world(3, 0.1);
    engine::Model model;
    model.motions.push_back(world.moved({1, 2}, turn, true));
    const auto simulation = world.simulate(springs(), with("rk4", 1e-3), model);
    REQUIRE(simulation);
    while (simulation->time() < 1) {
      REQUIRE(simulation->step(1, world.diagnostics));
      if (sync_often) simulation->sync();
    }
    world.run(*simulation, 1);
    CHECK(std::abs(world.position(2)[0] - std::cos(0.7)) < 1e-14);
    CHECK(std::abs(world.position(1)[1] - 0.5 * std::sin(0.7)) < 1e-14);
    return simulation->state_hash();
  };
  CHECK(end(false) == end(true));
}

TEST_CASE("contradictions and failures of decree are errors") {
  const auto message = [](const std::function<void(ParticleWorld&, engine::Model&)>& arrange) {
    ParticleWorld world(3, 0.1);
    engine::Model model;
    arrange(world, model);
    auto simulation = world.simulate(springs(), with("rk4", 1e-3), model);
    for (int i = 0; simulation && i < 1000; ++i)
      if (!simulation->step(10, world.diagnostics)) break;
    CHECK(world.diagnostics.has_errors());
    return world.messages();
  };
  CHECK(message([](ParticleWorld& world, engine::Model& model) {
          world.fix(1);
          model.motions.push_back(world.moved({0, 1}, "(0, 0, 0)", false));
        }).find("both fixed and moved") != std::string::npos);
  CHECK(message([](ParticleWorld& world, engine::Model& model) {
          model.motions.push_back(world.moved({0, 1}, "(0, 0, 0)", false));
          model.motions.push_back(world.moved({1}, "(0, 0, 1)", false));
        }).find("moved by two prescribed motions") != std::string::npos);
  const std::string late = message([](ParticleWorld& world, engine::Model& model) {
    model.motions.push_back(world.moved({0}, "(0, 0, 1 [m] / (0.1 [s] - time))", false));
  });
  CHECK_MESSAGE(late.find("t = 0.1 s") != std::string::npos, late);
}

}  // namespace
}  // namespace gmsim
