// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

#include "engine/guard.h"
#include "support/integrator_settings.h"
#include "support/particle_world.h"

namespace gmsim {
namespace {

using tests::ForcesOf;
using tests::Oscillators;
using tests::ParticleWorld;
using tests::VertexRecord;
using tests::with_warning;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST_CASE("one look finds whatever is no number") {
  engine::PhasePoint point;
  point.resize(5);
  point.motion.velocity[2] = {3, 0, 4};
  const engine::Guard::Finding sound = engine::Guard::look(point);
  CHECK(sound.finite);
  CHECK(sound.row == 2);
  CHECK(sound.max_speed == 5);
  for (const double bad : {kNaN, std::numeric_limits<double>::infinity(), -1e300 * 1e300}) {
    for (std::vector<VertexRecord>* array :
         {&point.motion.position, &point.motion.velocity, &point.force}) {
      engine::PhasePoint broken = point;
      const std::size_t which = array == &point.force ? 2 : array == &point.motion.velocity ? 1 : 0;
      (which == 2   ? broken.force
       : which == 1 ? broken.motion.velocity
                    : broken.motion.position)[3]
          .y = bad;
      const engine::Guard::Finding finding = engine::Guard::look(broken);
      CHECK_FALSE(finding.finite);
      CHECK(finding.row == 3);
    }
  }
  point.motion.velocity[4] = {1e200, 0, 0};  // its square is infinite
  CHECK_FALSE(engine::Guard::look(point).finite);
  CHECK(engine::Guard::look(point).row == 4);
}

TEST_CASE("nothing that is no number leaves a step") {
  for (const std::string method :
       {"symplectic_euler", "velocity_verlet", "rk4", "bogacki_shampine", "dormand_prince"}) {
    ParticleWorld world(3);
    // Fails in the velocity first: the force is no number from t = 0.1 on, on one vertex.
    auto forces = std::make_unique<ForcesOf>([](const VertexRecord& x, const VertexRecord&, double t) {
      return VertexRecord{0, 0, t > 0.1 && x.x > 0.9 ? kNaN : 1};
    });
    engine::IntegratorSettings settings = with_warning(method, 0.03);
    settings.dt_max = 0.03;
    const auto simulation = world.simulate(std::move(forces), settings);
    REQUIRE(simulation);
    std::uint64_t good = 0;
    double time = 0;
    for (int i = 0; i < 100000; ++i) {
      const auto report = simulation->step(1, world.diagnostics);
      if (!report) break;
      good = simulation->state_hash();
      time = report->time;
    }
    REQUIRE(world.diagnostics.has_errors());
    CHECK(time <= 0.1);
    CHECK(simulation->time() == time);
    CHECK(simulation->state_hash() == good);
    simulation->sync();
    for (std::uint32_t k = 0; k < 3; ++k) {
      CHECK(std::isfinite(world.position(k)[2]));
      CHECK(std::isfinite(world.velocity(k)[2]));
    }
    CHECK_MESSAGE(world.messages().find("vertex (1, ") != std::string::npos, world.messages());
  }
}

TEST_CASE("a run above its limit is stopped early, with the limit") {
  for (const std::string method : {"symplectic_euler", "velocity_verlet", "rk4"}) {
    ParticleWorld world(3);
    world.place(0, {0.01, 0, 0});
    const auto simulation = world.simulate(std::make_unique<Oscillators>(1, 0), with_warning(method, 4));
    REQUIRE(simulation);
    REQUIRE(world.diagnostics.all().size() == 1);  // the warning
    int steps = 0;
    while (simulation->step(1e9, world.diagnostics)) REQUIRE(++steps < 50);
    CHECK(world.diagnostics.has_errors());
    CHECK(world.messages().find("diverged") != std::string::npos);
    CHECK(world.messages().find("dt/limit") != std::string::npos);
    const engine::Totals totals = simulation->totals();
    CHECK_MESSAGE(totals.kinetic + totals.potential < 1000, method);
  }
}

TEST_CASE("a fast body is no blow-up") {
  ParticleWorld world(3);
  for (std::uint32_t k = 0; k < 3; ++k) world.throw_at(k, {500, 0, 0});
  const auto simulation = world.simulate(
      std::make_unique<tests::SpringChain>(1, 0.5, 0, 1), with_warning("velocity_verlet", 0.1));
  REQUIRE(simulation);
  for (int i = 0; i < 1000; ++i) REQUIRE(simulation->step(1e9, world.diagnostics));
  CHECK(world.diagnostics.all().empty());
}

TEST_CASE("an error of the forces is passed on with step and time") {
  class Failing final : public tests::HandWrittenForces {
   public:
    bool evaluate(const tests::Motion&, double time, double,
                  std::span<VertexRecord> force) override {
      for (VertexRecord& f : force) f = {};
      if (time > 0.5)
        failure = support::Diagnostic{support::DiagnosticKind::NonFinite, "non-finite force"};
      return time <= 0.5;
    }
  };
  ParticleWorld world(2);
  const auto simulation = world.simulate(std::make_unique<Failing>(), with_warning("rk4", 0.1));
  REQUIRE(simulation);
  while (simulation->step(1, world.diagnostics)) {}
  CHECK(simulation->steps() == 5);
  CHECK(world.messages().find("non-finite force\n  note: step 6, t = 0.6 s") != std::string::npos);
}

}  // namespace
}  // namespace gmsim
