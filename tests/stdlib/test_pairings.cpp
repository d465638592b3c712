// SPDX-License-Identifier: MIT
// Every criterion of the library with every change that tears, on meshes of every kind of element.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <set>

#include "gmap/orbit_walk.h"
#include "gmap/validate.h"
#include "stdlib/criterion_scene.h"

namespace gmsim::test {
namespace {

using gmap::DartId;
using types::OrbitType;

struct Body {
  const char* name;
  int dimension;
  const char* mesh;
};

const std::vector<Body>& bodies() {
  static const std::vector<Body> list = {
      {"chain", 1, "{ chain: { segments: 5 } }"},
      {"quads", 2, "{ grid: { patches: [3, 2], cells: quads } }"},
      {"triangles", 2, "{ grid: { patches: [2, 2], cells: triangles } }"},
      {"quads and triangles", 2, "{ grid: { patches: [3, 2], cells: mix4 } }"},
      {"tetrahedra", 3, "{ box: { cells: [1, 1, 1], elements: tets6 } }"},
      {"hexahedra", 3, "{ box: { cells: [2, 2, 2], elements: hexes } }"},
      {"a hexahedron under a pyramid, beside it a prism under a tetrahedron", 3,
       "{ points: [[0,0,0], [1,0,0], [1,1,0], [0,1,0], [0,0,1], [1,0,1], [1,1,1], [0,1,1], [0.5,0.4,2], "
       "[2,0.5,0], [2,0.5,1], [1.5,0.5,2]], "
       "cells: [[0,1,2,3,4,5,6,7], [4,5,6,7,8], [1,9,2,5,10,6], [5,10,6,11]] }"},
  };
  return list;
}

const std::vector<std::string> kChanges = {"separate_elements", "separate_faces",  "remove_element",
                                           "split_vertex",      "split_edge_end",  "split_edge_ends",
                                           "remove_edge_elements"};

/// All springs, on an unevenly stretched and moving body; one line of `tear` for each pairing.
std::string scene_text(const Body& body, const std::vector<std::string>& criteria) {
  std::string springs = "stretch_spring: { stiffness: 60, damping: 0.1 }";
  if (body.dimension > 1)
    springs += ", linear_shear_spring: { stiffness: 43 }, angular_shear_spring: { stiffness: 3 }, "
               "linear_bending_spring: { stiffness: 10 }, angular_bending_spring: { stiffness: 2 }";
  if (body.dimension > 2) springs += ", shear_spring_3d: { stiffness: 20 }";
  std::string tears;
  for (const std::string& criterion : criteria)
    for (const std::string& change : kChanges)
      tears += fmt::format("  - {{ when: {}, threshold: 1e-3, do: {} }}\n", criterion, change);
  return fmt::format(
      "dimension: {}\nbodies: [ {{ mesh: {}, mass: 1, interactions: {{ {} }},\n"
      "  initial: [ {{ position: \"(1.5 * position.x + 0.1 [1/m] * position.y^2, 1.4 * position.y - 0.2 [1/m] * "
      "position.x^2, 1.3 * position.z + 0.3 [1/m] * position.x * position.y)\", velocity: \"1 [m/s] * (random(1, "
      "vertex(a)), random(2, vertex(a)), random(3, vertex(a)))\" }} ] }} ]\n"
      "tear:\n{}integrator: {{ method: symplectic_euler, dt: 1e-6 }}\nduration: 1\n",
      body.dimension, body.mesh, springs, tears);
}

std::unique_ptr<engine::State> copy(const engine::State& from) {
  auto to = std::make_unique<engine::State>(from.program, from.map);
  to->seed = from.seed;
  for (const types::EmbeddingId id : from.store.embeddings()) {
    to->use(id);
    for (const DartId dart : gmap::all_orbits(from.map, from.store.schema()[id].orbit))
      if (const auto value = from.store.get(id, dart); !value.empty()) to->store.set(id, dart, value);
  }
  return to;
}

/// A copy of the scene's state, stepped with one line of `tear`, or with that line asleep.
struct Run {
  std::unique_ptr<engine::State> state;
  std::unique_ptr<engine::Simulation> simulation;
  support::Diagnostics diagnostics;

  Run(const scene::Scene& scene, std::size_t line, bool awake) : state(copy(*scene.state)) {
    begin(scene, line, awake);
  }
  /// Goes on from the state as it is.
  void begin(const scene::Scene& scene, std::size_t line, bool awake) {
    engine::Model model = scene.model;
    model.tears = {scene.model.tears[line]};
    if (!awake) model.tears[0].after = 1e9;
    simulation = engine::Simulation::create(*state, model, scene.integrator, {}, diagnostics);
    REQUIRE(simulation);
  }
  engine::StepReport step() {
    const auto report = simulation->step(1e30, diagnostics);
    REQUIRE_MESSAGE(report.has_value(), diagnostics.all().back().message);
    simulation->sync();
    return *report;
  }
  [[nodiscard]] types::EmbeddingId id(const char* name) const {
    return *state->program.schema.find(name);
  }
  /// Mass, then momentum, of the corners whose darts are alive in `alive`.
  [[nodiscard]] std::array<double, 4> totals(const gmap::GMap& alive) const {
    std::array<double, 4> sums{};
    for (const DartId corner : gmap::all_orbits(state->map, state->program.schema[id("corner_mass")].orbit)) {
      if (!alive.alive(corner)) continue;
      const double mass = state->store.get(id("corner_mass"), corner)[0];
      const auto velocity = state->store.get(id("velocity"), corner);
      sums[0] += mass;
      for (std::size_t k = 0; k < 3; ++k) sums[k + 1] += mass * velocity[k];
    }
    return sums;
  }
};

/// Every dart that is left has the place, the velocity and the mass of its corner that it had, bit by bit.
void check_untouched(const Run& torn, const Run& whole) {
  std::size_t changed = 0;
  for (const char* name : {"position", "velocity", "corner_mass"})
    for (std::uint32_t d = 0; d < torn.state->map.dart_end(); ++d) {
      if (!torn.state->map.alive(DartId{d})) continue;
      const auto now = torn.state->store.get(torn.id(name), DartId{d});
      const auto before = whole.state->store.get(whole.id(name), DartId{d});
      changed += !std::equal(now.begin(), now.end(), before.begin(), before.end());
    }
  CHECK(changed == 0);
}

void check_vertex_masses(const Run& torn) {
  const types::EmbeddingId mass = torn.id("mass"), corner_mass = torn.id("corner_mass");
  const OrbitType vertex = torn.state->program.schema[mass].orbit;
  const OrbitType corner = torn.state->program.schema[corner_mass].orbit;
  const double total = torn.simulation->totals().mass;
  double sum = 0;
  for (const DartId v : gmap::all_orbits(torn.state->map, vertex))
    for (const DartId c : gmap::quotient(torn.state->map, vertex, corner, v))
      sum += torn.state->store.get(corner_mass, c)[0];
  CHECK(total == doctest::Approx(sum).epsilon(1e-14));
}

/// One line of one scene, beside the step of its criterion while nothing tears; the number of events.
std::size_t check_pairing(const scene::Scene& scene, std::size_t line, const Run& whole) {
  Run torn(scene, line, true);
  const std::size_t events = torn.step().events.size();
  CHECK(gmap::validate(torn.state->map, torn.state->store).empty());
  check_untouched(torn, whole);
  check_vertex_masses(torn);
  if (torn.state->map.dart_count() == 0) return events;
  // The forces of what is left cancel: they do not move its centre.
  const auto before = whole.totals(torn.state->map);
  torn.begin(scene, line, false);
  torn.step();
  const auto after = torn.totals(torn.state->map);
  for (std::size_t k = 0; k < 4; ++k) CHECK(std::abs(after[k] - before[k]) <= 1e-14);
  return events;
}

/// All that look at no spring, or at one that the body has.
std::vector<std::string> criteria_of(const Body& body) {
  CriterionScene scene(scene_text(body, {}));
  const compile::Program& program = scene.scene().program;
  std::vector<std::string> names;
  for (const compile::CriterionBody& criterion : program.criterion_bodies) {
    const auto is_its_spring = [&](const engine::ActiveInteraction& active) {
      return program.interaction_bodies[active.interaction].id == *criterion.interaction;
    };
    if (!criterion.interaction || std::ranges::any_of(scene.scene().model.interactions, is_its_spring))
      names.push_back(criterion.name);
  }
  return names;
}

/// A body with all its pairings: line k * kChanges.size() + i is the i-th change of the k-th criterion.
struct Setting {
  explicit Setting(const Body& of)
      : body(&of),
        criteria(criteria_of(of)),
        scene(std::make_unique<CriterionScene>(scene_text(of, criteria))) {}
  const Body* body;
  std::vector<std::string> criteria;
  std::unique_ptr<CriterionScene> scene;
};

/// Events of each change under one criterion; a body that lacks what the criterion looks at has none.
std::vector<std::size_t> check_criterion(const Setting& setting, const std::string& criterion,
                                         const std::vector<std::size_t>& so_far) {
  std::vector<std::size_t> events = so_far;
  const auto found = std::ranges::find(setting.criteria, criterion);
  if (found == setting.criteria.end()) return events;
  const auto first = static_cast<std::size_t>(found - setting.criteria.begin()) * kChanges.size();
  Run whole(setting.scene->scene(), first, false);
  REQUIRE(whole.step().events.empty());
  for (std::size_t i = 0; i < kChanges.size(); ++i) {
    CAPTURE(kChanges[i]);
    if (events[i] == 0) events[i] = check_pairing(setting.scene->scene(), first + i, whole);
  }
  return events;
}

TEST_CASE("every criterion goes with every change, on every kind of element") {
  std::size_t first = std::random_device{}() % 1000;  // over the runs every pairing meets every body
  for (const int dimension : {1, 2, 3}) {
    std::vector<Setting> settings;
    for (const Body& body : bodies())
      if (body.dimension == dimension) settings.emplace_back(body);
    std::set<std::string> criteria;
    for (const Setting& setting : settings)
      criteria.insert(setting.criteria.begin(), setting.criteria.end());
    for (const std::string& criterion : criteria) {
      CAPTURE(criterion);
      std::vector<std::size_t> events(kChanges.size(), 0);
      for (std::size_t k = 0; k < settings.size(); ++k) {
        const Setting& setting = settings[(first + k) % settings.size()];
        CAPTURE(std::string(setting.body->name));
        events = check_criterion(setting, criterion, events);
        if (std::ranges::find(events, 0u) == events.end()) break;
      }
      for (std::size_t i = 0; i < kChanges.size(); ++i)
        CHECK_MESSAGE(events[i] > 0, kChanges[i], " never tears in dimension ", dimension);
      ++first;
    }
  }
}

}  // namespace
}  // namespace gmsim::test
