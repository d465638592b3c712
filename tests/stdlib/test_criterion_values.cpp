// SPDX-License-Identifier: MIT
// The values of the facet criteria: under a stress that is known, and of springs against their energy.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <span>

#include "engine/tree_eval.h"
#include "stdlib/criterion_scene.h"

namespace gmsim::test {
namespace {

using Vector = std::array<double, 3>;

Vector cross(const Vector& u, const Vector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
double dot(const Vector& u, const Vector& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }
std::string text(const Vector& v) { return fmt::format("({:.17g}, {:.17g}, {:.17g})", v[0], v[1], v[2]); }

// ---- a stress that is known ---------------------------------------------------------------------

/// Every element pulls its corners as a material under the stress p I + q d d^T would: each facet's share of
/// its traction goes to its corners in equal parts.
constexpr const char* kUniformStress = R"(
function outward(h) = facet_measure(h) * facet_normal(h) / count(c in halffacet(h) / corner);
interaction uniform_stress on element(a) {
    param p : real;  param q : real;  param d : vec3;
    force c in element(a) / corner on corner =
        -sum(h in corner(c) / halffacet : p * outward(h) + q * dot(d, outward(h)) * d);
}
)";

struct Kind {
  const char* mesh;
  int dimension;
  std::vector<double> literal;  ///< eq. 4 over stress times measure, the factors that may occur
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> list = {
      {"{ grid: { patches: [3, 2], size: [1, 2], cells: triangles } }", 2, {1}},
      {"{ grid: { patches: [2, 2], size: [1, 2], cells: tri4 } }", 2, {1}},
      {"{ grid: { patches: [3, 2], size: [1, 2], cells: quads } }", 2, {2}},
      {"{ grid: { patches: [3, 2], size: [1, 2], cells: mix2 } }", 2, {1, 1.5}},
      {"{ box: { cells: [2, 2, 1], elements: tets6 } }", 3, {2.0 / 3}},
      {"{ box: { cells: [2, 2, 1], elements: tets5 } }", 3, {2.0 / 3}},
      {"{ box: { cells: [2, 2, 2], elements: hexes } }", 3, {2}},
      // Two prisms on two prisms: across triangles, and across quads.
      {"{ points: [[0,0,0], [1,0,0], [1,2,0], [0,2,0], [0,0,1], [1,0,1], [1,2,1], [0,2,1], [0,0,3], [1,0,3], [1,2,3], "
       "[0,2,3]], cells: [[0,1,2,4,5,6], [0,2,3,4,6,7], [4,5,6,8,9,10], [4,6,7,8,10,11]] }",
       3, {2, 1}},
      // Two pyramids base to base, a hexahedron under a pyramid, a prism beside it with a tetrahedron on top.
      {"{ points: [[0,0,0], [1,0,0], [1,1,0], [0,1,0], [0.3,0.5,1], [0.5,0.4,-1]], "
       "cells: [[0,1,2,3,4], [0,3,2,1,5]] }", 3, {2.0 / 3}},
      {"{ points: [[0,0,0], [1,0,0], [1,1,0], [0,1,0], [0,0,1], [1,0,1], [1,1,1], [0,1,1], [0.5,0.4,2], [2,0.5,0], "
       "[2,0.5,1], [1.5,0.5,2]], "
       "cells: [[0,1,2,3,4,5,6,7], [4,5,6,7,8], [1,9,2,5,10,6], [5,10,6,11]] }",
       3, {1.5, 4.0 / 3, 2.0 / 3 + 2.0 / 3}},
  };
  return list;
}

std::string stressed(const Kind& kind, const Vector& d, const std::string& criterion,
                     const std::string& threshold) {
  return fmt::format(
      "dimension: {}\nrules: [criteria, tear, ./my.rule]\n"
      "bodies: [ {{ mesh: {}, mass: 1, interactions: {{ uniform_stress: {{ p: 30, q: 50, d: \"{}\" }} }},\n"
      "  initial: [ {{ position: \"(position.x + 0.3 * position.y - 0.2 * position.z, 1.1 * position.y + 0.1 * "
      "position.z, 0.9 * position.z)\" }} ] }} ]\n"
      "tear: [ {{ when: {}, threshold: \"{}\", do: separate_elements }} ]\n"
      "integrator: {{ dt: 1e-3 }}\nduration: 1\n",
      kind.dimension, kind.mesh, text(d), criterion, threshold);
}

TEST_CASE("the same stress gives the same traction on every kind of cell, and a literal force by its kind") {
  const Vector d = {0.6, 0.5, 0.2};
  for (const Kind& kind : kinds()) {
    CAPTURE(kind.mesh);
    const std::string traction = fmt::format("(30 + 50 * dot(facet_normal(a), {})^2)", text(d));
    const std::string force = fmt::format("1 [N/m^{}] * facet_measure(a) * ", kind.dimension - 1);
    const std::vector<double> normalised =
        CriterionScene(stressed(kind, d, "facet_traction", "1 [Pa] * " + traction), kUniformStress).ratios();
    CHECK(normalised.size() > 0);
    for (const double ratio : normalised) CHECK(ratio == doctest::Approx(1).epsilon(1e-13));

    const std::vector<double> literal =
        CriterionScene(stressed(kind, d, "atomic_facet_force", force + traction),
                       kUniformStress)
            .ratios();
    CHECK(literal.size() == normalised.size());
    for (const double ratio : literal) {
      CAPTURE(ratio);
      CHECK(std::any_of(kind.literal.begin(), kind.literal.end(),
                        [&](double factor) { return std::abs(ratio - factor) < 1e-12; }));
    }
  }
}


// ---- springs ------------------------------------------------------------------------------------

using Points = std::vector<Vector>;

/// Two elements that share the facet in the plane x = 0.
struct Pair {
  int dimension;
  Points points;
  std::vector<std::vector<int>> cells;
};

const std::vector<Pair>& pairs() {
  static const Points kQuads = {{0, 0, 0}, {0, 1, 0}, {-1.1, 1.2, 0}, {-0.9, -0.1, 0}, {1.3, 0.1, 0}, {1, 0.8, 0}};
  static const Points kSquare = {{0, 0, 0}, {0, 1, 0}, {0, 1.1, 1}, {0, 0, 1}};
  const auto with = [](Points points, const Points& more) {
    points.insert(points.end(), more.begin(), more.end());
    return points;
  };
  static const std::vector<Pair> list = {
      {2, kQuads, {{0, 1, 2, 3}, {1, 0, 4, 5}}},
      {2, kQuads, {{0, 1, 2}, {1, 0, 4}}},
      {2, kQuads, {{0, 1, 2, 3}, {1, 0, 4}}},
      {2, with(kQuads, {{0.5, 1.5, 0}}), {{0, 1, 2}, {1, 0, 4, 5, 6}}},
      {3, {{0, 0, 0}, {0, 1, 0}, {0, 0.2, 1}, {-1, 0, 0.1}, {0.8, 0.3, 0}}, {{0, 1, 2, 3}, {0, 2, 1, 4}}},
      {3, with(kSquare, {{-1, 0.4, 0.5}, {1.2, 0.5, 0.4}}), {{0, 3, 2, 1, 5}, {0, 1, 2, 3, 4}}},
      {3, with(kSquare, {{-1, 0, 0}, {-1, 1, 0}, {-1.1, 1, 1}, {-1, 0, 1.2}, {1, 0.2, 0.5}, {1, 0.9, 0.4}}),
       {{4, 5, 6, 7, 0, 1, 2, 3}, {0, 3, 8, 1, 2, 9}}},
      {3, with(kSquare, {{-1, 0, 0}, {-1, 1, 0}, {-1.1, 1, 1}, {-1, 0, 1.2}, {1, 0.2, 0.5}}),
       {{4, 5, 6, 7, 0, 1, 2, 3}, {0, 3, 2, 1, 8}}},
  };
  return list;
}

/// The springs of an element, and those that join two of a surface.
std::string springs(int dimension, bool joining) {
  std::string text = "stretch_spring: { stiffness: 60, rest: 0.4 }, angular_shear_spring: { stiffness: 3, rest: 1 }, "
                     "linear_shear_spring: { stiffness: 43, rest_ac: 1, rest_bd: 0.9 }";
  if (dimension == 3) text += ", shear_spring_3d: { stiffness: 20, rest_ag: 1, rest_bh: 1, rest_ce: 1, rest_df: 1 }";
  if (dimension == 3 || joining)
    text += ", linear_bending_spring: { stiffness: 10, rest: 0.5 }, angular_bending_spring: { stiffness: 2, rest: 0.3 }";
  return text;
}

/// `map` gives the image of a vector, as rows.
using Map = std::array<Vector, 3>;
Vector image(const Map& map, const Vector& x) { return {dot(map[0], x), dot(map[1], x), dot(map[2], x)}; }

std::string pair_scene(const Pair& pair, std::span<const std::vector<int>> cells, const Map& map) {
  Points used;
  std::vector<int> number(pair.points.size(), -1);
  std::string cell_text;
  for (const std::vector<int>& cell : cells) {
    std::vector<int> corners;
    for (const int point : cell) {
      if (number[point] < 0) {
        number[point] = static_cast<int>(used.size());
        used.push_back(image(map, pair.points[point]));
      }
      corners.push_back(number[point]);
    }
    cell_text += fmt::format("[{}],", fmt::join(corners, ","));
  }
  std::string points;
  for (const Vector& x : used) points += fmt::format("[{:.17g},{:.17g},{:.17g}],", x[0], x[1], x[2]);
  return fmt::format(
      "dimension: {}\nbodies: [ {{ mesh: {{ points: [{}], cells: [{}] }}, mass: 1, interactions: {{ {} }} }} ]\n"
      "tear: [ {{ when: facet_traction, threshold: 1, do: separate_elements }} ]\n"
      "integrator: {{ dt: 1e-6, on_unstable: warn }}\nduration: 1\n",
      pair.dimension, points, cell_text, springs(pair.dimension, cells.size() > 1));
}

struct Element {
  double energy = 0, measure = 0;
};

/// An element by itself.
Element alone(const Pair& pair, const std::vector<int>& cell, const Map& map) {
  CriterionScene scene(pair_scene(pair, {&cell, 1}, map) +
                       "expect: [ { value: \"element_measure(a)\", at: end, at_least: 0 } ]\n");
  engine::TreeEvaluator evaluator(scene.state());
  const engine::DartExpression& value = scene.scene().expectations[0].value;
  engine::Frame frame(value.frame_size);
  frame.set(value.dart, scene.scene().expectations[0].dart);
  Element result{.energy = scene.simulation().totals().potential};
  REQUIRE(evaluator.evaluate(*value.value, frame, {&result.measure, 1}));
  return result;
}

/// The unit normal of the plane x = 0 after the map; of surfaces, in their plane.
Vector normal_of_facet(int dimension, const Map& map) {
  const Vector along = image(map, {0, 1, 0});
  const Vector other = dimension == 3 ? image(map, {0, 0, 1}) : cross(image(map, {1, 0, 0}), along);
  Vector normal = cross(along, other);
  const double length = std::sqrt(dot(normal, normal));
  for (double& x : normal) x /= length;
  return normal;
}

TEST_CASE("the traction of springs is the change of their energy with a stretch across the facet") {
  const std::uint32_t seed = std::random_device{}() % 100000;
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> small(-0.3, 0.3);
  for (const Pair& pair : pairs()) {
    Map map = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (Vector& row : map)
      for (double& x : row) x += small(random);
    const Vector n = normal_of_facet(pair.dimension, map);
    const auto stretched = [&](double by) {
      Map result = map;
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
          for (int j = 0; j < 3; ++j) result[i][k] += by * n[i] * n[j] * map[j][k];
      return result;
    };
    double expected = 0;
    for (const std::vector<int>& cell : pair.cells) {
      const double h = 1e-5;
      const Element more = alone(pair, cell, stretched(h)), less = alone(pair, cell, stretched(-h));
      expected += 0.5 * (more.energy - less.energy) / h / (more.measure + less.measure);
    }
    const std::vector<double> values = CriterionScene(pair_scene(pair, pair.cells, map)).ratios();
    CAPTURE(pair.dimension);
    CAPTURE(pair.cells[0].size());
    CAPTURE(pair.cells[1].size());
    REQUIRE(values.size() == 1);
    CHECK(values[0] == doctest::Approx(expected).epsilon(1e-7));
  }
}


// ---- given forces -------------------------------------------------------------------------------

constexpr const char* kGivenForce =
    "interaction given on corner(a) { param f : vec3 [N]; force a on corner = f; }\n";

/// The edge from A to B between the faces ABC and BAD; two more faces at A and B only. Reference: a computation of
/// eqs. 3 to 5 apart from this program.
std::string edge_of_two_faces(double sign1, double sign2, const std::string& criterion) {
  const auto face = [](const Vector& x) { return "norm(centroid(a) - " + text(x) + ") < 1e-6"; };
  const std::string at_a = "norm(position - (0.1, 0, 0)) < 1e-6", at_b = "norm(position - (0, 1, 0.2)) < 1e-6";
  const Vector face1 = {-0.8 / 3, 1.4 / 3, 0.5 / 3}, face2 = {0.3, 0.5, 0.2};
  const std::string force = fmt::format(
      "if {0} then {1} * (if {2} then (-0.3, 0.02, 0.05) else if {3} then (-0.25, -0.04, 0.1) else (0, 0, 0)) "
      "else if {4} then {5} * (if {2} then (0.28, 0.01, 0.08) else if {3} then (0.35, 0.03, -0.02) else (0, 0, 0)) "
      "else if {2} then (0.05, -0.02, 0.01) else if {3} then (-0.04, 0.06, 0.02) else (0, 0, 0)",
      face(face1), sign1, at_a, at_b, face(face2), sign2);
  return fmt::format(
      "dimension: 2\nrules: [criteria, tear, ./my.rule]\nbodies:\n  - mass: 1\n"
      "    mesh: {{ points: [[0.1,0,0], [0,1,0.2], [-0.9,0.4,0.3], [0.8,0.5,0.4], [-0.5,-0.6,0.2], [-0.7,1.3,0.1]], "
      "cells: [[0,1,2], [1,0,3], [0,2,4], [1,5,2]] }}\n"
      "    interactions: {{ given: {{ f: \"{}\" }} }}\n"
      "tear: [ {{ when: {}, threshold: \"if norm(0.5 * (a.position + a@0.position) - (0.05, 0.5, 0.1)) < 1e-9 "
      "then 1 else 1e9\" }} ]\nintegrator: {{ dt: 1e-3 }}\nduration: 1\n",
      force, criterion);
}

/// The value at that edge, or none when it does not count.
std::optional<double> edge_value(double sign1, double sign2, const std::string& criterion) {
  const auto ratios = CriterionScene(edge_of_two_faces(sign1, sign2, criterion), kGivenForce).ratios();
  const auto largest = std::max_element(ratios.begin(), ratios.end());
  return largest != ratios.end() && *largest > 1e-6 ? std::optional(*largest) : std::nullopt;
}

TEST_CASE("given forces: eqs. 4 and 5 at an edge, pulled, pushed and both") {
  const auto equals = [](double value) { return doctest::Approx(value).epsilon(1e-12); };
  CHECK(edge_value(1, 1, "atomic_facet_force").value() == equals(1.16759900448426));
  CHECK(!edge_value(1, -1, "atomic_facet_force"));
  CHECK(!edge_value(-1, -1, "atomic_facet_force"));
  CHECK(edge_value(1, 1, "global_facet_force").value() == equals(0.11635459612160139));
  CHECK(edge_value(1, -1, "global_facet_force").value() == equals(1.151670791029196));
  CHECK(edge_value(-1, -1, "global_facet_force").value() == equals(0.08449816921146953));
}

TEST_CASE("springs of two moving quads: eqs. 4 and 5 at their edge") {
  const Points rest = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  const Points x = {{0, 0.03, 0},
                    {1.316829419696158, -0.012484405096414271, 0.007056000402993361},
                    {2.6181859485365138, -0.01960930862590836, -0.013970774909946294},
                    {0.002822400161197344, 1.078805108599511, 0.020605924262087832},
                    {1.2848639500938415, 1.0456349989857416, -0.02682864590002175},
                    {2.5808215145067375, 1.0248278541277065, 0.032514392007855844}};
  const Points v = {{0.1, 0, 0},
                    {0.05403023058681398, 0.04546487134128409, 0.02},
                    {-0.04161468365471424, -0.037840124765396416, 0.04},
                    {-0.09899924966004454, -0.013970774909946294, 0.06},
                    {-0.06536436208636119, 0.049467912331169095, 0.08},
                    {0.028366218546322625, -0.02720105554446849, 0.1}};
  std::string initial;
  for (std::size_t k = 0; k < x.size(); ++k)
    initial += fmt::format("{{ where: \"norm(position - {}) < 0.1\", position: \"{}\", velocity: \"{}\" }}, ",
                           text(rest[k]), text(x[k]), text(v[k]));
  const auto value = [&](const std::string& criterion) {
    return CriterionScene(
               fmt::format("dimension: 2\nrules: [springs, criteria, tear]\nbodies:\n"
                           "  - mesh: {{ grid: {{ patches: [2, 1], size: [2, 1] }} }}\n    mass: 1\n"
                           "    interactions:\n      stretch_spring: {{ stiffness: 60, damping: 0.1 }}\n"
                           "      linear_shear_spring: {{ stiffness: 43, damping: 0.1 }}\n"
                           "      linear_bending_spring: {{ stiffness: 10, damping: 0.1 }}\n"
                           "    initial: [ {} ]\n"
                           "tear: [ {{ when: {}, threshold: 1 }} ]\nintegrator: {{ dt: 1e-4 }}\nduration: 1\n",
                           initial, criterion))
        .ratios()
        .at(0);
  };
  CHECK(value("atomic_facet_force") == doctest::Approx(106.17443107234436).epsilon(1e-11));
  CHECK(value("global_facet_force") == doctest::Approx(0.17261332547988448).epsilon(1e-11));
}

TEST_CASE("two faces folded flat onto each other have no direction: nothing tears") {
  for (const std::string criterion : {"atomic_facet_force", "global_facet_force", "facet_traction"}) {
    CAPTURE(criterion);
    CriterionScene scene(fmt::format(
        "dimension: 2\nrules: [springs, criteria, tear]\nbodies:\n"
        "  - mesh: {{ points: [[0,0,0], [0,1,0], [1,0.5,0], [1,0.5,0]], cells: [[0,1,2], [1,0,3]] }}\n    mass: 1\n"
        "    interactions: {{ stretch_spring: {{ stiffness: 60, rest: 0.5 }} }}\n"
        "tear: [ {{ when: {}, threshold: 1e-6 }} ]\nintegrator: {{ dt: 1e-4 }}\nduration: 1\n", criterion));
    CHECK(scene.step().events.empty());
    for (const double ratio : scene.ratios()) CHECK(ratio == 0);
  }
}

}  // namespace
}  // namespace gmsim::test
