// SPDX-License-Identifier: MIT
// What a line of `tear:` can say: thresholds of every kind, where, at, at_most, after, parameters, defaults.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "stdlib/criterion_scene.h"
#include "support/diagnostic.h"

namespace gmsim::test {
namespace {

/// A free strip of quads of 1 m, stretched by half along x: eq. 4 reads 120 N at each inner edge, eq. 5 nothing.
std::string strip(int cells, const std::string& tear, const std::string& body = "",
                  const std::string& scene = "", const std::string& stretch = "1.5 * position.x") {
  return fmt::format(
      "dimension: 2\nrules: [springs, criteria, tear, ./my.rule]\n"
      "bodies:\n  - mesh: {{ grid: {{ patches: [{0}, 1], size: [{0}, 1] }} }}\n    mass: {0}\n"
      "    interactions: {{ stretch_spring: {{ stiffness: 60 }} }}\n{1}"
      "    initial: [ {{ position: \"({4}, position.y, 0)\" }} ]\n"
      "tear: [ {{ {2} }} ]\nintegrator: {{ dt: 1e-6 }}\nduration: 1\n{3}",
      cells, body, tear, scene, stretch);
}

constexpr const char* kStrength = "embedding strength : real [N] on element = 1000;\n";

/// Where the next step tears: x of each event, ascending.
std::vector<double> torn(CriterionScene& scene) {
  std::vector<double> places;
  for (const engine::TearEvent& event : scene.step().events)
    places.push_back(std::round(event.position[0] * 1000) / 1000);
  std::sort(places.begin(), places.end());
  return places;
}
std::vector<double> torn(const std::string& text) {
  CriterionScene scene(text, kStrength);
  return torn(scene);
}
using Places = std::vector<double>;
const Places kAll = {1.5, 3, 4.5};

TEST_CASE("thresholds: numbers, units, expressions, values of cells") {
  CHECK(torn(strip(4, "when: atomic_facet_force, threshold: 119")) == kAll);
  CHECK(torn(strip(4, "when: atomic_facet_force, threshold: 121")) == Places{});
  CHECK(torn(strip(4, "when: atomic_facet_force, threshold: 0.119 kN")) == kAll);
  CHECK(torn(strip(4, "when: atomic_facet_force, threshold: \"if position.x < 2 then 1 [kN] else 1 [N]\"")) ==
        Places{3, 4.5});
  const std::string weak = strip(4, "when: atomic_facet_force, threshold: \"min(strength, a@n.strength)\"");
  CHECK(torn(weak) == Places{});
  CHECK(torn(exchanged(weak, "initial: [", "initial: [ { where: \"centroid(a).x < 1\", strength: 50 },")) ==
        Places{1.5});
}

TEST_CASE("thresholds and conditions read forces, on orbits that nothing else reads too") {
  // Inside the strip the springs on a vertex or a face are in balance, at its ends they are not.
  const auto with = [](const std::string& more) {
    return strip(4, "when: atomic_facet_force, threshold: " + more);
  };
  CHECK(torn(with("\"119 [N] + norm(force_on(vertex(a)))\"")) == kAll);
  CHECK(torn(with("\"119 [N] + norm(force_on(face(a)))\"")) == kAll);
  CHECK(torn(with("\"200 [N] - norm(force_on(halfedge(a)))\"")) == Places{});
  CHECK(torn(with("1, where: \"norm(force_on(vertex(a))) < 1e-6\"")) == kAll);
  CHECK(torn(with("1, where: \"norm(force_on(vertex(a))) > 1e-6\"")) == Places{});
  CHECK(torn(with("1, where: \"max(f in forces(vertex(a)) : norm(f)) > 29 [N]\"")) == kAll);
  CHECK(torn(with("1, where: \"max(f in forces(vertex(a)) : norm(f)) > 31 [N]\"")) == Places{});
}

TEST_CASE("what may not tear does not come near to tearing") {
  const std::string line = "when: atomic_facet_force, threshold: 100";
  CHECK(CriterionScene(strip(4, line), kStrength).ratios().size() == 3);
  CriterionScene scene(strip(4, line + ", where: \"position.x > 4\""), kStrength);
  const std::vector<double> ratios = scene.ratios();
  REQUIRE(ratios.size() == 1);
  CHECK(ratios[0] == doctest::Approx(1.2));
  support::Diagnostics diagnostics;
  const auto reports = scene.simulation().survey(diagnostics);
  REQUIRE(reports);
  CHECK(reports->at(0).nearest.position[0] == doctest::Approx(4.5));
}

TEST_CASE("the nearest is the strongest, whatever the order in which others are judged") {
  // Two rows of quads that are longer to the right, cut through on the left. The edge between the rows there then ends at
  // three edges, as the last one does, which is longer: it is judged after that one, and has an older dart.
  const std::string rules =
      "criterion far on facet(a) {\n  match a -n- b;\n"
      "  value edge_length(a) * (1 + 0 * count(x in vertex(a) / edge));\n}\n"
      "criterion cut on facet(a) {\n  match a -n- b;\n"
      "  value if abs(a.position.x - 1.1 [m]) + abs(a@0.position.x - 1.1 [m]) < 0.01 [m] then 1 else 0;\n}\n";
  CriterionScene scene(
      "dimension: 2\nrules: [tear, ./my.rule]\n"
      "bodies:\n  - mesh: { grid: { patches: [6, 2], size: [6, 2] } }\n    mass: 1\n"
      "    initial: [ { position: \"(position.x + 0.1 [1/m] * position.x * position.x, position.y, 0)\" } ]\n"
      "tear: [ { when: far, threshold: 0.5, do: separate_elements, after: 1.5e-6 }, "
      "{ when: cut, threshold: 0.5, do: separate_elements } ]\n"
      "integrator: { dt: 1e-6 }\nduration: 1\n",
      rules);
  CHECK(scene.step().events.size() == 2);
  CHECK(scene.step().events.size() > 2);
  support::Diagnostics diagnostics;
  const auto reports = scene.simulation().survey(diagnostics);
  REQUIRE(reports);
  CHECK(reports->at(0).nearest.value == doctest::Approx(2.1));
}

TEST_CASE("a threshold that is not above 0 somewhere stops the run and says where") {
  CriterionScene scene(strip(4, "when: atomic_facet_force, threshold: \"1 [N/m] * (position.x - 2 [m])\""),
                       kStrength);
  CHECK_THROWS_WITH_AS(scene.step(), doctest::Contains("threshold"), std::runtime_error);
}

TEST_CASE("thresholds from the cells of a mesh file") {
  const std::string mesh =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n"
      "$EndNodes\n$Elements\n2\n1 3 2 0 1 1 2 5 4\n2 3 2 0 1 2 3 6 5\n$EndElements\n"
      "$ElementData\n1\n\"toughness\"\n1\n0\n3\n0\n1\n2\n1 {}\n2 {}\n$EndElementData\n"
      "$NodeData\n1\n\"push\"\n1\n0\n3\n0\n3\n6\n1 0 0 1\n2 0 0 2\n3 0 0 3\n4 0 0 4\n5 0 0 5\n6 0 0 6\n$EndNodeData\n";
  const std::string rules = std::string(kStrength) + "embedding push : vec3 [mm/s] on vertex = (0, 0, 0);\n";
  const std::string text = exchanged(
      strip(2, "when: atomic_facet_force, threshold: \"min(strength, a@n.strength)\"",
            "    data: { strength: toughness, push: push }\n", "",
            "1.5 * position.x"),
      "{ grid: { patches: [2, 1], size: [2, 1] } }", "{ file: cells.msh }");
  const std::string thrown = exchanged(text, "initial: [", "initial: [ { velocity: push },");
  const auto file = [&](int one, int other) {
    return std::vector{std::pair<std::string, std::string>{"cells.msh", fmt::format(fmt::runtime(mesh), one, other)}};
  };
  const auto events = [&](int one, int other) {
    CriterionScene scene(thrown, rules, file(one, other));
    const double speed = scene.simulation().totals().momentum[2];
    CHECK(speed == doctest::Approx(7e-3));
    return scene.step().events.size();
  };
  CHECK(events(130, 70) == 1);
  CHECK(events(70, 130) == 1);
  CHECK(events(130, 140) == 0);
  const auto error = [&](const std::string& from, const std::string& to) {
    try {
      CriterionScene(exchanged(thrown, from, to), rules, file(70, 70));
    } catch (const std::runtime_error& said) {
      return std::string(said.what());
    }
    return std::string();
  };
  CHECK(error("strength: toughness", "strength: toughnes").find("did you mean `toughness`?") != std::string::npos);
  CHECK(error("push: push }", "push: toughness }").find("no data of points and no group called `toughness`") !=
        std::string::npos);
  CHECK(error("push: push }", "velocity: push, mass: push }").find("`mass` cannot be set") != std::string::npos);
  CHECK(error("push: push }", "fixed: push }").find("has 3 components") != std::string::npos);
}

TEST_CASE("random thresholds are a field of the scene's seed") {
  for (const std::string threshold :
       {"120 [N] * (0.5 + random(7, facet(a)))", "120 [N] * (-log(1 - random(7, facet(a))))^(1/3)"}) {
    const std::string tear = "when: atomic_facet_force, threshold: \"" + threshold + "\"";
    const Places first = torn(strip(40, tear, "", "seed: 1\n"));
    CHECK(first == torn(strip(40, tear, "", "seed: 1\n")));
    CHECK(first != torn(strip(40, tear, "", "seed: 2\n")));
    CHECK(first != torn(strip(40, exchanged(tear, "random(7", "random(8"), "", "seed: 1\n")));
    CHECK(first.size() > 5);
    CHECK(first.size() < 35);
  }
}

TEST_CASE("where, after, at_most") {
  const std::string tear = "when: atomic_facet_force, threshold: 1, ";
  CHECK(torn(strip(4, tear + "where: \"position.x < 4\"")) == Places{1.5, 3});
  CriterionScene late(strip(4, tear + "after: 2.5e-6"), kStrength);
  CHECK(torn(late) == Places{});
  CHECK(torn(late) == Places{});
  CHECK(torn(late) == kAll);
  // All are equal, so all of them are the strongest; further stretched, there is one.
  CHECK(torn(strip(4, tear + "at_most: 1")) == kAll);
  const std::string uneven = "1.5 * position.x + 0.1 [1/m] * position.x^2";
  CHECK(torn(strip(4, tear + "at_most: 1", "", "", uneven)) == Places{5.4});
  CHECK(torn(strip(4, tear + "at_most: 2", "", "", uneven)) == Places{3.4, 5.4});
}

TEST_CASE("at: the nodes of the pattern, one after another") {
  // The middle spring on the lower border, whichever way it runs.
  const std::string tear =
      "when: spring_elongation, threshold: 1.2, do: split_vertex, "
      "where: \"norm(0.5 * (a.position + a@0.position) - (3.75, 0, 0)) < 0.1\", at: ";
  const Places by_a = torn(strip(5, tear + "[a]")), by_b = torn(strip(5, tear + "[b]"));
  REQUIRE(by_a.size() == 1);
  REQUIRE(by_b.size() == 1);
  CHECK(std::min(by_a[0], by_b[0]) == 3);
  CHECK(std::max(by_a[0], by_b[0]) == 4.5);
  CHECK(torn(strip(5, tear + "[a, b]")) == Places{3, 4.5});
}

TEST_CASE("parameters go to the criterion, the change, or both") {
  // 60 N over an edge of 1 m.
  CHECK(torn(strip(4, "when: facet_traction, threshold: 59 Pa")).size() == 3);
  CHECK(torn(strip(4, "when: facet_traction, threshold: 59 kPa")) == Places{});
  CHECK(torn(strip(4, "when: facet_traction, threshold: 59 kPa, params: { thickness: 1 mm }")).size() == 3);
  // Across the strip nothing lies on both sides; along it the plane parts the elements.
  const std::string vertex = "when: atomic_vertex_force, threshold: 1, params: { normal: ";
  CHECK(torn(strip(4, vertex + "[0, 1, 0] }")) == Places{});
  CHECK(torn(strip(4, vertex + "[1, 0, 0] }")).size() >= 3);
  try {
    torn(strip(4, "when: facet_traction, threshold: 1, params: { thicknes: 1 }"));
    FAIL("an unknown parameter is an error");
  } catch (const std::runtime_error& said) {
    CHECK(std::string(said.what()).find("neither `facet_traction` nor `separate_elements` has a parameter "
                                        "`thicknes`") != std::string::npos);
    CHECK(std::string(said.what()).find("did you mean `thickness`?") != std::string::npos);
  }
}

TEST_CASE("loads on the parts of a torn vertex add up to what they were") {
  const std::string loads =
      "loads:\n  - vertex_drag: { coefficient: \"0.1 [N s/m] * (1 + random(3, vertex(a)))\" }\n"
      "  - plane_obstacle: { point: [0, 0, -1], normal: [0, 0, 1], stiffness: 100, damping: \"2 [N s/m] * "
      "random(4, vertex(a))\" }\n";
  CriterionScene scene(strip(4, "when: atomic_facet_force, threshold: 1", "    prepare: [ { apply: split_quad } ]\n",
                             loads),
                       kStrength);
  const auto sums = [&] {
    return std::array{scene.sum("vertex_drag.coefficient"), scene.sum("plane_obstacle.stiffness"),
                      scene.sum("plane_obstacle.damping")};
  };
  const auto before = sums();
  CHECK(before[1] == doctest::Approx(1000));
  CHECK(!scene.step().events.empty());
  const auto after = sums();
  for (std::size_t k = 0; k < before.size(); ++k)
    CHECK(std::abs(after[k] - before[k]) <= 1e-14 * before[k]);
}

}  // namespace
}  // namespace gmsim::test
