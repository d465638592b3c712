// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <random>

#include "unit/scene/scene_files.h"

using namespace gmsim;
using test::exchanged;
using test::kCloth;
using test::LoadedScene;
using test::SceneFolder;

namespace {

std::string errors_of(const std::string& text, const scene::SceneOptions& options = {}) {
  const SceneFolder folder;
  folder.write("ten.rule", "function ten(a) = 10;\n");
  return LoadedScene(folder.write("scene.yaml", text), options).errors();
}

}  // namespace

TEST_CASE("what only rules can tell: names, types, units, constants, with their places") {
  struct Row {
    const char* from;
    const char* to;
    const char* error;
  };
  for (const Row& row : {
           Row{"stretch_spring:   ", "stretch_sprng:   ",
               "10:7 unknown-item: no interaction or family named `stretch_sprng` in dimension 2"},
           Row{"stiffness: 60", "stifness: 60",
               "10:32 unknown-name: `stretch_spring` has no parameter `stifness`"},
           Row{"stiffness: 60", "stiffness: 60 N", "10:43 unit-mismatch"},
           Row{"stiffness: 60", "stiffness: 60 N/q", "unknown-unit"},
           Row{"stiffness: 60", "stiffness: \"60 * tru\"", "10:49 unknown-name"},
           Row{"stiffness: 60", "stiffness: true", "10:43 type-mismatch"},
           Row{"stiffness: 60", "stiffness: [1, 2, 3]", "10:43 type-mismatch"},
           Row{"stiffness: 60, ", "",
               "10:7 missing-key: `stretch_spring` needs its parameter `stiffness`"},
           Row{"stiffness: 60", "stiffness: \"1 / 0\"", "non-finite"},
           Row{"velocity: \"(0, 0, 0)\"", "velocty: \"(0, 0, 0)\"",
               "13:61 unknown-embedding: no embedding named `velocty`"},
           Row{"velocity: \"(0, 0, 0)\"", "mass: 3",
               "13:61 bad-assignment: `mass` cannot be set: it is computed from other values"},
           Row{"apply: split_quad", "apply: split_quda",
               "8:25 unknown-item: no rule or operation named `split_quda` in dimension 2"},
           Row{"apply: split_quad", "apply: sew_elements",
               "8:25 bad-item: `sew_elements` has 2 hooks"},
           Row{"to: face", "to: fac", "8:41 unknown-orbit: no orbit named `fac` in dimension 2"},
           Row{"to: face", "params: { x: 1 }",
               "8:47 unknown-name: `split_quad` has no parameter `x`"},
           Row{"body: cloth", "body: clot", "16:17 unknown-name: no body is called `clot`"},
           Row{"rules: [springs", "rules: [sprngs",
               "2:9 import-not-found: `sprngs` is neither a module of the library nor a file"},
           Row{"vertex_drag", "drag", "15:12 unknown-item"},
           Row{"velocity: [\"0\", \"-0.1\", \"0\"]", "speed: 3",
               "unknown-key: there is no key `speed` here"},
           Row{"velocity: [\"0\", \"-0.1\", \"0\"]", "velocity: [0, -0.1]", "type-mismatch"},
           Row{"velocity: [\"0\", \"-0.1\", \"0\"]", "velocity: [\"0\", \"-0.1 [m]\", \"0\"]",
               "unit-mismatch"},
           Row{", velocity: [\"0\", \"-0.1\", \"0\"]", "",
               "17:9 missing-key: this does not say how the vertices move"},
           Row{"fields: [velocity", "fields: [velocty", "21:53 unknown-name"},
           Row{"name: fall", "name: mass", "duplicate-name: two fields are called `mass`"},
           Row{"value: \"norm(velocity)\"", "value: a",
               "type-mismatch: a number, vector or matrix is needed"},
           Row{"equals: 0.5, within: 1e-6", "equals: 0.5",
               "22:77 missing-key: `equals` needs `within`, how far off it may be"},
           Row{"equals: 0.5", "equals: [0.5, 1, 2]",
               "type-mismatch: the value has 1 component, this has 3"},
           Row{"equals: 0.5", "equals: 0.5 kg", "unit-mismatch"},
           Row{"at: end", "at: 3", "out-of-range: this is after the end, 2 s"},
           Row{"at: end", "at: end, point: 121", "out-of-range: `cloth` has no point 121"},
           Row{"patches: [10, 10]", "patches: [100000, 100000]",
               "out-of-range: these are more than 50000000 cells"},
           Row{"dimension: 2", "dimension: 3",
               "dimension: a grid is of dimension 2, this scene of dimension 3"},
           Row{"{ grid: {", "{ file: a.msh, grid: {",
               "5:26 conflict: the mesh comes from `file` already"},
           Row{"grid: { patches: [10, 10], size: [1.0, 1.0], cells: quads }", "file: none.msh",
               "5:19 file-error"},
           Row{"grid: { patches: [10, 10], size: [1.0, 1.0], cells: quads }", "",
               "missing-key: this does not say where the mesh comes from"},
           Row{"grid: { patches: [10, 10], size: [1.0, 1.0], cells: quads }",
               "points: [[0,0,0], [1,0,0], [0,1,0]], cells: [[0, 1, 3]]",
               "out-of-range: there is no point 3: they are numbered from 0 to 2"},
           Row{"grid: { patches: [10, 10], size: [1.0, 1.0], cells: quads }",
               "points: [[0,0,0], [1,0,0], [2,0,0]], cells: [[0, 1, 2]]",
               "mesh-topology: mesh of `cloth`"},
           Row{"mass: 0.1", "mass: { per_vertex: \"-1\" }",
               "out-of-range: the mass is -1 kg at dart"},
           Row{"mass: 0.1", "mass: { density: 1 kg/m^3 }", "unit-mismatch"},
           Row{"mass: 0.1", "mass: {}", "missing-key: this does not say what the mass is"},
           Row{"vertex_drag: { coefficient: 0.0 }", "gravity: { g: [0, 0, 1] }",
               "conflict: `gravity` acts twice at dart"},
           Row{"where: \"position.y < 0.001\"", "where: \"position.y > 0.999\"",
               "conflict: the vertex of dart"},
           Row{"where: \"position.y < 0.001\"", "where: \"position.y < -1\"",
               "17:19 empty-selection: this holds at no vertex"},
           Row{"where: \"position.y < 0.001\"", "where: \"position < 0.001\"",
               "17:28 type-mismatch"},
           Row{"damping: 0.1, where: \"true\"", "damping: 0.1, where: \"false\"",
               "10:7 empty-selection: `stretch_spring` acts nowhere in `cloth`"},
       }) {
    const std::string what = std::string(row.from) + " -> " + row.to;
    INFO(what);
    const std::string errors = errors_of(exchanged(kCloth, row.from, row.to));
    INFO(errors);
    CHECK(errors.find(row.error) != std::string::npos);
  }
}

TEST_CASE("one run shows mistakes of all kinds, each at its place in the file") {
  std::string text = exchanged(kCloth, "stiffness: 43", "stifness: 43");
  text = exchanged(text, "position.y > 0.999", "positoin.y > 0.999");
  text = exchanged(text, "dt: 1e-3", "dt: -1");
  text = exchanged(text, "1.5 * position", "1.5 * velocity");
  const std::string errors = errors_of(text);
  INFO(errors);
  for (const char* error :
       {"11:32 unknown-name", "16:32 unknown-name", "18:32 out-of-range", "unit-mismatch",
        "11:7 missing-key: `linear_shear_spring` needs its parameter `stiffness`"})
    CHECK(errors.find(error) != std::string::npos);
}

TEST_CASE("places in folded and quoted texts, in lists and in overrides") {
  const std::string fix =
      "fix:  [ { body: cloth, where: \"position.y > 0.999 and (position.x < 0.001 or position.x > "
      "0.999)\", "
      "on_split: both } ]";
  CHECK(
      errors_of(exchanged(kCloth, fix, "fix:\n  - where: >\n      position.y\n      > velocty.x\n"))
          .find("19:9 unknown-name") == 0);
  CHECK(errors_of(exchanged(kCloth, fix, "fix:\n  - where: position.y\n      > velocty.x\n"))
            .find("18:9 unknown-name") == 0);
  CHECK(errors_of(exchanged(kCloth, fix, "fix:\n  - where: 'velocty.x > 0'\n"))
            .find("17:13 unknown-name") == 0);
  // Escapes move the letters: the whole text is the place.
  CHECK(errors_of(exchanged(kCloth, fix, "fix:\n  - where: \"0 < \\x76elocty.x\"\n"))
            .find("17:13 unknown-name") == 0);
  CHECK(errors_of(exchanged(kCloth, "[0, 0, -9.81]", "[0, 0, -9.81 * gee]"))
            .find("14:25 unknown-name") == 0);
}

TEST_CASE("overrides are checked like the file, at their own places") {
  CHECK(
      errors_of(kCloth, {.overrides = {"bodies.cloth.interactions.stretch_spring.stiffness=60 kg"}})
          .find("unit-mismatch") != std::string::npos);
  CHECK(
      errors_of(kCloth, {.overrides = {"bodies.cloth.interactions.stretch_spring.stiffness=70 N/m",
                                       "duration=3 s"}}) == "");
}

TEST_CASE("files that are not there, folders, rules with mistakes") {
  support::SourceMap sources;
  support::Diagnostics diagnostics;
  CHECK(scene::load_scene("no/such/scene.yaml", {}, sources, diagnostics) == nullptr);
  CHECK(test::brief(diagnostics, sources) ==
        "file-error: cannot read `no/such/scene.yaml`: No such file or directory\n");
  CHECK(LoadedScene(".").errors().find("it is a folder") != std::string::npos);
  CHECK(errors_of(exchanged(kCloth, "rules: [springs", "rules: [./ten.rule")) == "");
  const SceneFolder folder;
  folder.write("bad.rule", "function f(a) = ;\n");
  CHECK(
      LoadedScene(folder.write("s.yaml", exchanged(kCloth, "rules: [springs", "rules: [bad.rule")))
          .errors()
          .find("syntax") != std::string::npos);
}

TEST_CASE("checking alone builds no state") {
  const SceneFolder folder;
  const LoadedScene checked(folder.write("s.yaml", kCloth),
                            {.overrides = {}, .library = {}, .build = false});
  CHECK(checked.rendered() == "");
  REQUIRE(checked.scene != nullptr);
  CHECK(checked.scene->state == nullptr);
}

TEST_CASE("mutations of a scene give errors or a scene, never a crash") {
  const std::string pieces[] = {
      "[",          "]",   "{",        "}",    ":",    ",",         "\"", "0",
      "-1",         "1e9", "position", "a@0",  "time", " N/m",      "\n", "sum(x in vertex(a) : x)",
      "free(a, 3)", "(",   ")",        "true", "null", "all vertex"};
  const std::string small = exchanged(kCloth, "[10, 10]", "[2, 2]");
  const SceneFolder folder;
  for (std::uint32_t seed = 0; seed < 150; ++seed) {
    std::mt19937 random(seed);
    std::string text = small;
    for (int k = 0; k < 1 + static_cast<int>(random() % 2); ++k) {
      const std::size_t at = random() % text.size();
      if (random() % 3 == 0)
        text.erase(at, random() % 8);
      else
        text.insert(at, pieces[random() % std::size(pieces)]);
    }
    INFO("seed " << seed);
    const LoadedScene loaded(folder.write("s.yaml", text));
    (void)loaded.rendered();
    CHECK((loaded.scene != nullptr) != loaded.diagnostics.has_errors());
  }
}
