// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "gmap/orbit_walk.h"
#include "gmap/validate.h"
#include "unit/scene/scene_files.h"

using namespace gmsim;
using engine::ParameterBinding;
using test::exchanged;
using test::kCloth;
using test::LoadedScene;
using test::SceneFolder;
using types::OrbitType;

namespace {

std::vector<std::filesystem::path> scenes_below(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".yaml") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// A square of one quad, corner (0, 0) to (1, 1), with what is added to the body and to the scene.
std::string square(const std::string& body = "", const std::string& scene = "") {
  return "dimension: 2\n"
         "bodies:\n"
         "  - name: square\n"
         "    mesh: { grid: { patches: [1, 1] } }\n"
         "    mass: 1\n" +
         body + "duration: 1\n" + scene;
}

/// Values of an embedding by point number.
std::vector<std::vector<double>> by_point(const LoadedScene& loaded, const std::string& name) {
  std::vector<std::vector<double>> values;
  for (std::uint32_t dart = 0; dart < loaded.scene->dart_point.size(); ++dart) {
    if (!loaded.state().map.alive(gmap::DartId{dart})) continue;
    const std::uint32_t point = loaded.scene->dart_point[dart];
    if (values.size() <= point) values.resize(point + 1);
    const auto value = loaded.state().store.get(loaded.id(name), gmap::DartId{dart});
    values[point].assign(value.begin(), value.end());
  }
  return values;
}

/// The same but for numbers of darts, which `prepare` may give out in any order.
void check_equal(const LoadedScene& a, const LoadedScene& b) {
  CHECK(a.scene->resolved == b.scene->resolved);
  CHECK(a.scene->dart_point == b.scene->dart_point);
  REQUIRE(a.state().store.embeddings() == b.state().store.embeddings());
  for (const types::EmbeddingId id : a.state().store.embeddings()) {
    const auto left = a.state().store.column(id).data(), right = b.state().store.column(id).data();
    CHECK(std::equal(left.begin(), left.end(), right.begin(), right.end()));
  }
  REQUIRE(a.scene->model.interactions.size() == b.scene->model.interactions.size());
  for (std::size_t i = 0; i < a.scene->model.interactions.size(); ++i)
    for (std::size_t k = 0; k < a.scene->model.interactions[i].parameters.size(); ++k) {
      const auto& left = a.scene->model.interactions[i].parameters[k];
      const auto& right = b.scene->model.interactions[i].parameters[k];
      CHECK(left.kind == right.kind);
      CHECK(left.uniform.data == right.uniform.data);
    }
  CHECK(a.scene->expectations.size() == b.scene->expectations.size());
  CHECK(a.scene->output.fields.size() == b.scene->output.fields.size());
}

}  // namespace

TEST_CASE("every scene of the project loads, and so does its resolved text, which gives the same") {
  for (const auto& path : scenes_below("scenes")) {
    INFO(path.string());
    const LoadedScene loaded(path);
    CHECK(loaded.rendered() == "");
    REQUIRE(loaded.scene != nullptr);
    CHECK(gmap::validate(loaded.state().map, loaded.state().store).empty());
    const SceneFolder folder;  // with the rules and meshes that lie beside the scene
    for (const auto& entry : std::filesystem::directory_iterator(path.parent_path()))
      if (entry.is_regular_file() && entry.path().extension() != ".yaml")
        std::filesystem::copy(entry.path(), folder.path() / entry.path().filename());
    const LoadedScene again(folder.write("resolved.yaml", loaded.scene->resolved));
    CHECK(again.rendered() == "");
    REQUIRE(again.scene != nullptr);
    check_equal(loaded, again);
  }
}

TEST_CASE("the cloth of the language: what is in the state and in the model") {
  const SceneFolder folder;
  const LoadedScene loaded(folder.write("cloth.yaml", kCloth));
  REQUIRE(loaded.rendered() == "");
  const scene::Scene& scene = *loaded.scene;
  CHECK(loaded.sum("corner_mass") == doctest::Approx(0.1));
  const auto faces = gmap::all_orbits(loaded.state().map, OrbitType{0, 1}).size();
  CHECK(faces > 120);  // about half of the patches were cut
  CHECK(faces < 180);
  // Rest lengths were taken before the cloth was stretched by half.
  const auto position = by_point(loaded, "position");
  CHECK(position.at(60) == std::vector<double>{0.75, 0.75, 0});
  const auto& rest = loaded.state().store.column(loaded.id("stretch_spring.rest"));
  const auto& rows = loaded.state().store.index_of(loaded.id("stretch_spring.rest"));
  for (gmap::Row row = 0; row < rows.row_end(); ++row)
    CHECK((rest.get(row)[0] == doctest::Approx(0.1) ||
           rest.get(row)[0] == doctest::Approx(0.1 * std::sqrt(2))));
  CHECK(loaded.parameter("stretch_spring", "rest").kind == ParameterBinding::Kind::Stored);
  CHECK(loaded.parameter("stretch_spring", "stiffness").kind == ParameterBinding::Kind::Uniform);
  CHECK(loaded.parameter("stretch_spring", "stiffness").uniform.as_real() == 60);
  CHECK(!loaded.state().store.in_use(loaded.id("stretch_spring.stiffness")));
  CHECK(!loaded.state().store.in_use(loaded.id("angular_bending_spring.rest")));
  CHECK(!loaded.state().store.in_use(loaded.id("angular_bending_spring")));
  CHECK(loaded.parameter("gravity", "g").uniform.data == std::vector<double>{0, 0, -9.81});
  CHECK(loaded.active("vertex_drag") != nullptr);
  // `fix` and `move` saw the cloth as built: two corners, and the lower edge.
  CHECK(loaded.sum("fixed") == 2);
  REQUIRE(scene.model.motions.size() == 1);
  CHECK(scene.model.motions[0].vertices.size() == 11);
  CHECK(!scene.model.motions[0].gives_position);
  CHECK(scene.integrator.dt == 1e-3);
  CHECK(scene.output.fields.size() == 3);
  CHECK(scene.output.fields[0].orbit == OrbitType{1, 2});
  CHECK(scene.output.fields[2].type == types::ValueType{types::ValueKind::Real});
  CHECK(scene.expectations.at(0).at == 2);
  CHECK(scene.bodies.at(0).vertices.size() == 121);
  CHECK(scene.bodies[0].cells == faces);
}

TEST_CASE("meshes are scaled, then turned, then shifted; units are honoured") {
  const SceneFolder folder;
  const LoadedScene loaded(
      folder.write("s.yaml", square("    place: { scale: 2, rotate: { axis: [0, 0, 3], degrees: 90 "
                                    "}, translate: [5 cm, 0, 1] }\n")));
  REQUIRE(loaded.rendered() == "");
  const auto position = by_point(loaded, "position");
  const std::vector<std::vector<double>> wanted = {
      {0.05, 0, 1}, {0.05, 2, 1}, {-1.95, 0, 1}, {-1.95, 2, 1}};
  for (std::size_t p = 0; p < 4; ++p)
    for (std::size_t k = 0; k < 3; ++k)
      CHECK(position.at(p).at(k) == doctest::Approx(wanted[p][k]));
}

TEST_CASE("masses: of the body, by density, by vertex") {
  const SceneFolder folder;
  const std::string text = exchanged(square(), "[1, 1] }", "[2, 1], size: [3, 1], cells: mix2 }");
  CHECK(LoadedScene(folder.write("a.yaml", exchanged(text, "mass: 1", "mass: 250 g")))
            .sum("corner_mass") == doctest::Approx(0.25));
  CHECK(
      LoadedScene(folder.write("b.yaml", exchanged(text, "mass: 1", "mass: { density: 2 kg/m^2 }")))
          .sum("corner_mass") == doctest::Approx(6));
  const LoadedScene by_vertex(folder.write(
      "c.yaml", exchanged(text, "mass: 1",
                          "mass: { per_vertex: \"if position.x < 1 then 1 [g] else 0.5\" }")));
  REQUIRE(by_vertex.rendered() == "");
  CHECK(by_vertex.sum("corner_mass") == doctest::Approx(2 * 0.001 + 4 * 0.5));
}

TEST_CASE("parameters: the same everywhere, different by place, given at two bodies, of time") {
  const SceneFolder folder;
  const std::string two =
      "dimension: 1\n"
      "bodies:\n"
      "  - name: left\n"
      "    mesh: { chain: { segments: 2 } }\n"
      "    mass: 1\n"
      "    interactions: { stretch_spring: { stiffness: 5 } }\n"
      "  - name: right\n"
      "    mesh: { chain: { segments: 3, length: 6 } }\n"
      "    place: { translate: [10, 0, 0] }\n"
      "    mass: 1\n"
      "    interactions: { stretch_spring: { stiffness: 5 } }\n"
      "duration: 1\n";
  SUBCASE("one constant") {
    const LoadedScene loaded(folder.write("s.yaml", two));
    REQUIRE(loaded.rendered() == "");
    CHECK(loaded.parameter("stretch_spring", "stiffness").kind == ParameterBinding::Kind::Uniform);
    CHECK(loaded.sum("stretch_spring.rest") == doctest::Approx(2 * 1 + 2 * 6).epsilon(0.6));
    CHECK(loaded.scene->bodies.at(1).vertices.size() == 4);
    CHECK(by_point(loaded, "position").at(3) == std::vector<double>{10, 0, 0});
  }
  SUBCASE("two constants") {
    const LoadedScene loaded(
        folder.write("s.yaml", exchanged(two, "stiffness: 5", "stiffness: 7 N/mm")));
    REQUIRE(loaded.rendered() == "");
    CHECK(loaded.parameter("stretch_spring", "stiffness").kind == ParameterBinding::Kind::Stored);
    const double edges = loaded.sum("stretch_spring") / 5;  // marks for each edge
    CHECK(loaded.sum("stretch_spring.stiffness") == doctest::Approx(edges * (2 * 7000 + 3 * 5)));
  }
  SUBCASE("of time") {
    const std::string rising = "stiffness: \"5 [N/m] * (1 + time / (1 [s]))\" }";
    const std::string text =
        exchanged(exchanged(two, "stiffness: 5 }", rising), "stiffness: 5 }", rising);
    const LoadedScene loaded(folder.write("s.yaml", text));
    REQUIRE(loaded.rendered() == "");
    CHECK(loaded.parameter("stretch_spring", "stiffness").kind == ParameterBinding::Kind::OfTime);
    CHECK(!loaded.state().store.in_use(loaded.id("stretch_spring.stiffness")));
    CHECK(LoadedScene(folder.write("t.yaml", exchanged(two, "stiffness: 5 }", rising)))
              .errors()
              .find("not-available: `stiffness` of `stretch_spring` reads the time") !=
          std::string::npos);
  }
  SUBCASE("read by somebody else") {
    const LoadedScene loaded(folder.write(
        "s.yaml",
        two +
            "output: { fields: [ { name: k, value: a.stretch_spring.stiffness, on: edge } ] }\n"));
    REQUIRE(loaded.rendered() == "");
    CHECK(loaded.parameter("stretch_spring", "stiffness").kind == ParameterBinding::Kind::Stored);
  }
  SUBCASE("where: some dart of the orbit") {
    const std::string chosen =
        exchanged(two, "stiffness: 5 }", "stiffness: 5, where: \"position.x < 0.1\" }");
    const LoadedScene loaded(folder.write("s.yaml", chosen));
    REQUIRE(loaded.rendered() == "");
    CHECK(loaded.sum("stretch_spring") /
              (LoadedScene(folder.write("t.yaml", two)).sum("stretch_spring") / 5) ==
          4);
  }
}

TEST_CASE(
    "a family: each element takes the first member that fits, and every element must have one") {
  const SceneFolder folder;
  const std::string law =
      "    param stiffness : real [N/m]; energy 0.5 * stiffness * dot(a.position, a.position); "
      "force a on corner; }\n";
  folder.write("law.rule", "interaction tri_law on face(a) { match triangle(a, b, c);\n" + law +
                               "interaction quad_law on face(a) { match quad(a, b, c, d);\n" + law +
                               "family law = tri_law, quad_law;\n"
                               "family half = tri_law;\n");
  const std::string text =
      "rules: [./law.rule]\n" + exchanged(square("    interactions: { law: { stiffness: 3 } }\n"),
                                          "[1, 1] }", "[2, 1], size: [3, 1], cells: mix2 }");
  const LoadedScene loaded(folder.write("s.yaml", text));
  REQUIRE(loaded.rendered() == "");
  CHECK(loaded.sum("tri_law") == 2);
  CHECK(loaded.sum("quad_law") == 1);
  CHECK(LoadedScene(folder.write("t.yaml", exchanged(text, "law: { st", "half: { st")))
            .errors()
            .find("no-match: no member of the family `half` fits 1 of the elements") !=
        std::string::npos);
  CHECK(LoadedScene(folder.write("u.yaml", exchanged(text, "{ stiffness: 3 }", "{ stiffnes: 3 }")))
            .errors()
            .find("unknown-name: `law` has no parameter `stiffnes`") != std::string::npos);
}

TEST_CASE("bare numbers for parameters of rules are in the unit of their declaration") {
  const SceneFolder folder;
  folder.write("lift.rule",
               "rule lift(a) { left { a<1,2>; } param by : real [mm];\n"
               "  a.position = a.position + (0, 0, 1) * by; }\n");
  for (const char* by : {"250", "0.25 m", "\"25 [cm]\""}) {
    const LoadedScene loaded(folder.write(
        "s.yaml", "rules: [lift.rule]\n" + square("    prepare: [ { apply: lift, params: { by: " +
                                                  std::string(by) + " }, times: 2 } ]\n")));
    REQUIRE(loaded.rendered() == "");
    CHECK(by_point(loaded, "position").at(3).at(2) == doctest::Approx(0.5));
  }
}

TEST_CASE("mesh files lie beside the scene") {
  const SceneFolder folder;
  folder.write("roof.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
  const LoadedScene loaded(
      folder.write("s.yaml", exchanged(square(), "grid: { patches: [1, 1] }", "file: roof.obj")));
  REQUIRE(loaded.rendered() == "");
  CHECK(loaded.scene->bodies.at(0).cells == 2);
  CHECK(by_point(loaded, "position").at(2) == std::vector<double>{1, 1, 0});
}

TEST_CASE("points that rules make are numbered behind those of the mesh") {
  const SceneFolder folder;
  const LoadedScene loaded(folder.write(
      "s.yaml",
      square("    prepare: [ { apply: triangulate_face } ]\n",
             "expect: [ { value: position, point: 4, equals: [0.5, 0.5, 0], within: 0 } ]\n")));
  REQUIRE(loaded.rendered() == "");
  const auto position = by_point(loaded, "position");
  REQUIRE(position.size() == 5);
  CHECK(position[1] == std::vector<double>{1, 0, 0});
  CHECK(position[4] == std::vector<double>{0.5, 0.5, 0});
  CHECK(loaded.scene->dart_point.at(types::index(loaded.scene->expectations[0].dart)) == 4);
  CHECK(loaded.sum("corner_mass") == doctest::Approx(1));
}

TEST_CASE("initial values: in order, each reading the state before it, of any embedding") {
  const SceneFolder folder;
  folder.write("heat.rule", "embedding temperature : real [K] on vertex;\n");
  const std::string text =
      "rules: [./heat.rule]\n" +
      square(
          "    initial:\n"
          "      - { position: \"2 * position\", velocity: \"position / (1 [s])\" }\n"
          "      - { where: \"position.x > 1.5\", velocity: [0, 0, 1] }\n"
          "      - { temperature: 300 }\n",
          "output: { fields: [temperature] }\n");
  const LoadedScene loaded(folder.write("s.yaml", text));
  REQUIRE(loaded.rendered() == "");
  CHECK(by_point(loaded, "position").at(3) == std::vector<double>{2, 2, 0});
  CHECK(by_point(loaded, "velocity").at(2) == std::vector<double>{0, 1, 0});
  CHECK(by_point(loaded, "velocity").at(3) == std::vector<double>{0, 0, 1});
  CHECK(by_point(loaded, "temperature").at(0) == std::vector<double>{300});
  CHECK(LoadedScene(folder.write("t.yaml", exchanged(text, "      - { temperature: 300 }\n", "")))
            .errors() ==
        "missing-value: the scene gives no value for the embedding `temperature`\n");
  const LoadedScene unused(
      folder.write("u.yaml", exchanged(exchanged(text, "      - { temperature: 300 }\n", ""),
                                       "fields: [temperature]", "")));
  CHECK(unused.rendered() == "");
  CHECK(!unused.state().store.in_use(unused.id("temperature")));
}

TEST_CASE("tearing and rewriting are read for who can do them; what they divide gets a column") {
  const SceneFolder folder;
  folder.write("yield.rule",
               "rule yield(a) { left { a -0- b; } param limit : real;\n"
               "  where norm(b.position - a.position) > limit * a.stretch_spring.rest;\n"
               "  a.stretch_spring.rest = norm(b.position - a.position) / limit; }\n");
  const std::string text =
      "rules: [./yield.rule]\n" +
      square("    interactions: { stretch_spring: { stiffness: 3, rest: 1 } }\n",
             "fix: [ { on_split: release } ]\n"
             "rewrite: [ { apply: yield, to: halfedge, params: { limit: 1.2 } } ]\n"
             "tear: [ { when: spring_elongation, threshold: 1.5, do: separate_elements, at_most: 2 "
             "} ]\n");
  const LoadedScene loaded(folder.write("s.yaml", text));
  REQUIRE(loaded.rendered() == "");
  CHECK(loaded.scene->model.tears.size() == 1);
  CHECK(loaded.scene->model.tears[0].at_most == 2u);
  CHECK(loaded.scene->model.rewrites.size() == 1);
  REQUIRE(loaded.scene->model.holds.size() == 4);
  for (const engine::Hold& hold : loaded.scene->model.holds)
    CHECK(hold.on_split == engine::OnSplit::Release);
  CHECK(loaded.parameter("stretch_spring", "rest").kind == ParameterBinding::Kind::Stored);
  CHECK(LoadedScene(folder.write("t.yaml", exchanged(text, "threshold: 1.5", "threshold: 0")))
            .errors()
            .find("out-of-range: a threshold must be above 0") != std::string::npos);
}
