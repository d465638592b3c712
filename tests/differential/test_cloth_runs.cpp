// SPDX-License-Identifier: MIT
// Whole runs of a cloth of library springs against trajectories computed by independent programs.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/cloth_world.h"
#include "support/integrator_settings.h"

namespace gmsim {
namespace {

using gmap::GridCells;
using tests::ClothWorld;
using tests::with_warning;

const std::vector<std::uint32_t> kCorners = {0, 3, 12, 15};

/// 3 x 3 quads, corners fixed, damping 0.1 N s/m: positions after 1 s (DOP853, tolerance 1e-13).
const std::vector<std::array<double, 3>> kDampedQuads = {
    {0.0, 0.0, 0.0},
    {0.3317712395596428, 0.0027614404100920085, -0.08413237313283127},
    {0.668228760440357, 0.0027614404100922037, -0.0841323731328303},
    {1.0, 0.0, 0.0},
    {0.0027614404100921104, 0.3317712395596426, -0.08413237313283103},
    {0.3314797397668031, 0.33147973976680317, -0.14364443718432052},
    {0.6685202602331969, 0.3314797397668032, -0.1436444371843203},
    {0.9972385595899077, 0.3317712395596429, -0.08413237313283145},
    {0.0027614404100921182, 0.6682287604403571, -0.08413237313283005},
    {0.33147973976680295, 0.6685202602331971, -0.1436444371843202},
    {0.6685202602331968, 0.6685202602331971, -0.1436444371843205},
    {0.9972385595899078, 0.6682287604403571, -0.08413237313283158},
    {0.0, 1.0, 0.0},
    {0.3317712395596426, 0.9972385595899079, -0.08413237313283138},
    {0.6682287604403568, 0.9972385595899078, -0.08413237313283091},
    {1.0, 1.0, 0.0}};
/// 3 x 3 patches of two triangles, corners fixed, no damping.
const std::vector<std::array<double, 3>> kTriangles = {
    {0.0, 0.0, 0.0},
    {0.330512458593587, 0.00023691208064996914, -0.10101909962314988},
    {0.670470444338508, -0.0015631590124178542, -0.10343436064700756},
    {1.0, 0.0, 0.0},
    {0.00023691208065000315, 0.3305124585935893, -0.10101909962314935},
    {0.331824257711679, 0.331824257711678, -0.11073633942081855},
    {0.6671602279322725, 0.3328397720677272, -0.12159704665535642},
    {1.001563159012419, 0.3295295556614935, -0.10343436064700817},
    {-0.0015631590124211125, 0.6704704443385068, -0.10343436064700812},
    {0.33283977206772764, 0.6671602279322728, -0.12159704665535558},
    {0.6681757422883201, 0.6681757422883203, -0.11073633942081841},
    {0.9997630879193512, 0.6694875414064135, -0.10101909962314917},
    {0.0, 1.0, 0.0},
    {0.329529555661491, 1.0015631590124199, -0.10343436064700831},
    {0.6694875414064133, 0.9997630879193498, -0.10101909962314899},
    {1.0, 1.0, 0.0}};
/// 3 x 3 quads, the two corners with y = 1 fixed, damping 0.1 N s/m.
const std::vector<std::array<double, 3>> kSwinging = {
    {0.0005302738691398939, 1.9913773811868267, -0.04436828285804766},
    {0.3330010280117845, 1.9910326510502356, -0.01570535490453223},
    {0.6669989719882156, 1.9910326510502354, -0.01570535490453173},
    {0.9994697261308604, 1.991377381186826, -0.04436828285804584},
    {0.0012114392285558048, 1.6586912420408562, -0.0665898278995673},
    {0.33330037475480595, 1.6585382200757837, -0.038689750827793946},
    {0.666699625245194, 1.6585382200757837, -0.038689750827794314},
    {0.9987885607714443, 1.658691242040856, -0.0665898278995699},
    {0.0027413827288055516, 1.3243884185615316, -0.08139110410807014},
    {0.3336523726068431, 1.325528568481123, -0.042463728067714986},
    {0.6663476273931567, 1.3255285684811229, -0.042463728067714555},
    {0.9972586172711941, 1.3243884185615313, -0.08139110410807067},
    {0.0, 1.0, 0.0},
    {0.33309627788528556, 0.9934093757539552, -0.013504652100793872},
    {0.6669037221147143, 0.9934093757539553, -0.013504652100793477},
    {1.0, 1.0, 0.0}};

double damped_quads(const std::string& method, int steps) {
  ClothWorld world(3, GridCells::Quads, 0.1, kCorners);
  const auto simulation = world.simulate(with_warning(method, 1.0 / steps));
  REQUIRE_MESSAGE(simulation, world.messages());
  world.run(*simulation, 1);
  CHECK(simulation->steps() == static_cast<std::uint64_t>(steps));
  return world.error(kDampedQuads);
}
double triangles(const std::string& method, int steps) {
  ClothWorld world(3, GridCells::Triangles, 0, kCorners);
  const auto simulation = world.simulate(with_warning(method, 1.0 / steps));
  REQUIRE_MESSAGE(simulation, world.messages());
  world.run(*simulation, 1);
  return world.error(kTriangles);
}

void check_within(double value, double reference, double part) {
  CHECK_MESSAGE(std::abs(value / reference - 1) < part, value, " instead of ", reference);
}

TEST_CASE("errors of each method on the undamped cloth are those of the method") {
  check_within(triangles("rk4", 250), 6.564335333115414e-06, 0.03);
  check_within(triangles("rk4", 500), 3.5484767417593156e-07, 0.03);
  check_within(triangles("rk4", 1000), 2.013991871375391e-08, 0.03);
  check_within(triangles("velocity_verlet", 500), 8.425929024753073e-05, 0.03);
  check_within(triangles("velocity_verlet", 2000), 5.3052785174829525e-06, 0.03);
  check_within(triangles("symplectic_euler", 1000), 0.0007089671912176138, 0.03);
}

TEST_CASE("errors of each method on the damped cloth, and their orders") {
  check_within(damped_quads("rk4", 1000), 2.5401346196075784e-09, 0.03);
  check_within(damped_quads("rk4", 500), 3.942243969164319e-08, 0.03);
  check_within(damped_quads("symplectic_euler", 1000), 0.00042311399284957125, 0.03);
  // The velocity in the damping is corrected, so the order of Verlet stays 2.
  const double coarse = damped_quads("velocity_verlet", 1000);
  const double fine = damped_quads("velocity_verlet", 2000);
  CHECK_MESSAGE(std::abs(std::log2(coarse / fine) - 2) < 0.1, coarse, " ", fine);
  CHECK(fine < 0.1 * 3.943163182411411e-05);  // that of a lagged velocity
}

TEST_CASE("a swinging cloth follows the independent trajectory") {
  ClothWorld world(3, GridCells::Quads, 0.1, {12, 15});
  const auto simulation = world.simulate(with_warning("rk4", 2.5e-4));
  REQUIRE_MESSAGE(simulation, world.messages());
  world.run(*simulation, 1);
  CHECK(world.error(kSwinging) < 1e-9);
  CHECK(simulation->max_elongation() > 1);
}

TEST_CASE("tolerances: errors fall with them on a swinging cloth") {
  const auto run = [](double rtol) {
    ClothWorld world(3, GridCells::Quads, 0.1, {12, 15});
    engine::IntegratorSettings settings;
    settings.method = "dormand_prince";
    settings.rtol = rtol;
    const auto simulation = world.simulate(settings);
    REQUIRE_MESSAGE(simulation, world.messages());
    std::uint64_t rejected = 0;
    while (simulation->time() < 1) {
      const auto report = simulation->step(1, world.diagnostics);
      REQUIRE_MESSAGE(report, world.messages());
      rejected += report->rejected;
    }
    simulation->sync();
    CHECK(5 * rejected < simulation->steps());
    return world.error(kSwinging);
  };
  // From 1e-5 on; the stability limit holds coarser steps back, which only makes them better.
  const double slope = std::log10(run(1e-5) / run(1e-9)) / 4;
  CHECK_MESSAGE((slope > 0.8 && slope < 1.2), slope);
  CHECK(run(1e-3) < 1e-3);
}

TEST_CASE("stability estimates of cloths against eigenvalues") {
  struct Row {
    std::uint32_t patches;
    GridCells cells;
    std::vector<std::uint32_t> fixed;
    double lambda;  // largest eigenvalue of M^-1 K at rest, 1/s^2
  };
  const Row rows[] = {{3, GridCells::Quads, kCorners, 57163.227126196674},
                      {3, GridCells::Triangles, kCorners, 76637.83183094935},
                      {3, GridCells::Quads, {12, 15}, 60431.78425044051},
                      {10, GridCells::Quads, {110, 120}, 663436.846196323}};
  for (const Row& row : rows) {
    ClothWorld world(row.patches, row.cells, 0, row.fixed);
    const auto simulation = world.simulate(with_warning("rk4", 1e-3));
    REQUIRE_MESSAGE(simulation, world.messages());
    const engine::StabilityLimit& limit = simulation->limit();
    const double ratio = limit.omega_global * limit.omega_global / row.lambda;
    CHECK_MESSAGE((ratio >= 1 && ratio <= 1.1), row.lambda, " ratio ", ratio);
    CHECK(limit.omega_bound >= std::sqrt(row.lambda));
    CHECK(limit.omega_bound <= 1.4 * std::sqrt(row.lambda));
    CHECK(limit.dt_global <= 2.8284271 / std::sqrt(row.lambda));
  }
}

TEST_CASE("a step just below the limit finishes, one just above is refused") {
  const double limit = 2.0 / std::sqrt(76637.83183094935);
  const auto settings = [&](double part) {
    engine::IntegratorSettings result = with_warning("velocity_verlet", part * limit);
    result.on_unstable = engine::OnUnstable::Error;
    return result;
  };
  ClothWorld below(3, GridCells::Triangles, 0, kCorners);
  const auto simulation = below.simulate(settings(0.97));
  REQUIRE_MESSAGE(simulation, below.messages());
  CHECK_FALSE(below.diagnostics.has_errors());
  ClothWorld above(3, GridCells::Triangles, 0, kCorners);
  CHECK_FALSE(above.simulate(settings(1.03)));
  CHECK(above.messages().find("spring` at vertex") != std::string::npos);
}

TEST_CASE("a far too long step is reported before it starts, and stopped when it goes on") {
  ClothWorld world(3, GridCells::Quads, 0.1, kCorners);
  const auto simulation = world.simulate(with_warning("rk4", 0.1));
  REQUIRE(simulation);
  REQUIRE(world.diagnostics.all().size() == 1);
  CHECK(world.diagnostics.all()[0].kind == support::DiagnosticKind::Unstable);
  int steps = 0;
  while (simulation->step(100, world.diagnostics)) REQUIRE(++steps < 20);
  CHECK(world.diagnostics.all().back().kind == support::DiagnosticKind::Diverged);
  simulation->sync();
  for (std::uint32_t p = 0; p < 16; ++p)
    for (const double x : world.position(p)) CHECK(std::abs(x) < 100);
}

}  // namespace
}  // namespace gmsim
