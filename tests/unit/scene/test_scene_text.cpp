// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <random>

#include "scene/scene.h"
#include "scene/schema.h"
#include "unit/scene/scene_text.h"

using namespace gmsim;
using test::exchanged;
using test::kCloth;
using test::SceneText;

namespace {

/// Lines as errors() gives them.
std::string lines(std::initializer_list<std::string> all) {
  std::string text;
  for (const std::string& line : all) text += line + "\n";
  return text;
}

/// The least that is a scene, then `more`.
std::string small(const std::string& more = "") {
  return "dimension: 1\n"
         "bodies:\n"
         "  - name: chain\n"
         "    mesh: { chain: { segments: 3 } }\n"
         "    mass: 1\n"
         "duration: 1\n" +
         more;
}

std::string errors(const std::string& text) {
  return SceneText(text).errors();
}
std::string errors_of(const std::string& from, const std::string& to) {
  return errors(exchanged(kCloth, from, to));
}

}  // namespace

TEST_CASE("good scenes have no errors, and what is filled in is a scene again") {
  for (const std::string& text : {kCloth, small()}) {
    const SceneText scene(text);
    CHECK(scene.rendered() == "");
    const std::string resolved = scene::resolved_text(scene.tree);
    const SceneText again(resolved);
    CHECK(again.rendered() == "");
    CHECK(scene::same_values(again.tree, scene.tree));
    CHECK(scene::resolved_text(again.tree) == resolved);
  }
  const SceneText filled(small());
  REQUIRE(filled.tree.find("integrator") != nullptr);
  CHECK(filled.tree.find("integrator")->find("method")->text == "rk4");
}

TEST_CASE("text that is no YAML") {
  CHECK(errors("") == lines({"1:1 wrong-form: a mapping is needed here, this is nothing"}));
  CHECK(errors("a: [1, 2\nb: 3\n") ==
        lines({"2:2 yaml-syntax: this list in brackets is not closed"}));
  CHECK(errors("a: \"x\n") == lines({"1:4 yaml-syntax: this text in quotes is not closed"}));
  CHECK(errors("a:\n\tb: 1\n    \tc: 2\n") == lines({"2:1 yaml-syntax: a tab in the indentation",
                                                     "3:5 yaml-syntax: a tab in the indentation"}));
  CHECK(errors("a: \x01\n") ==
        lines({"1:4 yaml-syntax: a control character; a scene is UTF-8 text"}));
  CHECK(errors(small("seed: !!int 3\n")) ==
        lines({"7:7 yaml-syntax: tags such as `!!str` mean nothing in a scene"}));
  CHECK(errors(std::string(20000, '[')).find("nested deeper than the reader allows") !=
        std::string::npos);
  CHECK(errors("a: &x [*x]\n").find("this alias stands for a value that holds it") !=
        std::string::npos);
  CHECK(errors("{[1]: 2}\n").find("1:2 yaml-syntax: a key is a word, this is a list") == 0);
  CHECK(errors(small("---\nb: 1\n")) ==
        lines({"8:1 yaml-syntax: a second document begins here; a scene is one"}));
}

TEST_CASE("aliases stand for what they name") {
  const SceneText scene(small("stop_at: &t [0.1, 0.2]\noutput: { at: *t }\n"));
  CHECK(scene.rendered() == "");
  CHECK(scene.tree.find("output")->find("at")->items.size() == 2);
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 9; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int k = 0; k < 10; ++k) bomb += before + (k < 9 ? ", " : "]\n");
  }
  CHECK(errors(bomb).find("aliases stand for more values than fit") != std::string::npos);
}

TEST_CASE("keys: unknown, misspelt, misplaced, twice, missing") {
  CHECK(errors_of("damping: 0.1, where", "damping: 0.1, stiffness: 61, where") ==
        lines({"10:61 duplicate-key: the key `stiffness` stands here twice"}));
  CHECK(errors_of("duration: 2.0", "duratoin: 2.0") ==
        lines({"19:1 unknown-key: there is no key `duratoin` here",
               "1:1 missing-key: the key `duration` is missing"}));
  CHECK(errors_of("method: rk4, dt", "method: rk4, t") ==
        lines({"18:28 unknown-key: there is no key `t` here"}));
  CHECK(errors(small("dt: 1\n")) == lines({"7:1 unknown-key: there is no key `dt` here"}));
  CHECK(SceneText(small("dt: 1\n")).rendered().find("`dt` belongs under `integrator`") !=
        std::string::npos);
  CHECK(errors_of("    mass: 0.1\n", "") == lines({"4:5 missing-key: the key `mass` is missing"}));
  CHECK(errors_of("    mass: 0.1\n", "    mass:\n") ==
        lines({"4:5 missing-key: the key `mass` is missing"}));
  const std::string unquoted = exchanged(kCloth, "\"(0, 0, 0)\"", "(0, 0, 0)");
  CHECK(SceneText(unquoted).rendered().find(
            "put an expression that holds a comma or a colon in quotes") != std::string::npos);
}

TEST_CASE("forms and numbers") {
  struct Row {
    const char* from;
    const char* to;
    const char* error;
  };
  for (const Row& row :
       {Row{"patches: [10, 10]", "patches: 10",
            "5:30 wrong-form: a list of whole numbers is needed here, this is `10`"},
        Row{"patches: [10, 10]", "patches: [10]",
            "5:30 wrong-form: this list must have 2 entries, it has 1"},
        Row{"patches: [10, 10]", "patches: [10, 0]", "5:35 out-of-range: this must be at least 1"},
        Row{"patches: [10, 10]", "patches: [10, 2.5]",
            "5:35 wrong-form: a whole number is needed here, this is `2.5`"},
        Row{"cells: quads", "cells: quad",
            "5:65 unknown-choice: `quad` is none of the choices for `cells`"},
        Row{"mass: 0.1", "mass: -1", "7:11 out-of-range: this must be above 0 kg"},
        Row{"mass: 0.1", "mass: heavy",
            "7:11 wrong-form: a number or a mapping is needed here, this is `heavy`"},
        Row{"mass: 0.1", "mass: 1 m",
            "7:13 unit-mismatch: this is in [m], a value in [kg] is needed"},
        Row{"mass: 0.1", "mass: 1 kgg", "7:13 unknown-unit: no unit named `kgg`"},
        Row{"mass: 0.1", "mass: 1e999", "7:11 bad-number: this number is out of range"},
        Row{"mass: 0.1", "mass: { density: 0 }", "7:22 out-of-range: this must be above 0"},
        Row{"degrees: 0 }", "degrees: 40 deg }",
            "6:63 unit-mismatch: a number without unit is needed here"},
        Row{"dt: 1e-3", "dt: -1e-3", "18:32 out-of-range: this must be above 0 s"},
        Row{"dt: 1e-3", "dt: soon",
            "18:32 wrong-form: a number or `auto` is needed here, this is `soon`"},
        Row{"method: rk4", "method: rk5",
            "18:23 unknown-choice: `rk5` is none of the choices for `method`"},
        Row{"dimension: 2", "dimension: 4", "1:12 out-of-range: `dimension` cannot be 4"},
        Row{"where: \"true\", position", "where: yes, position",
            "13:25 wrong-form: `yes` is not taken for a truth value"},
        Row{"gravity: [0, 0, -9.81]", "gravity: [0]",
            "14:10 wrong-form: a vector has 2 or 3 components, this list 1"},
        Row{"loads: [ { vertex_drag", "loads: [ { wind: {}, vertex_drag",
            "15:10 wrong-form: one name is needed here, these are 2"}}) {
    const std::string what = std::string(row.from) + " -> " + row.to;
    INFO(what);
    CHECK(errors_of(row.from, row.to) == lines({row.error}));
  }
  CHECK(errors(small("output: { sync: no }\n")) ==
        lines({"7:17 wrong-form: `no` is not taken for a truth value"}));
  CHECK(errors(small("bodies: 3\n")) ==
        lines({"7:1 duplicate-key: the key `bodies` stands here twice"}));
}

TEST_CASE("values with units, and all ways to write a number") {
  SceneText scene(small("integrator: { dt: 0.5 ms, rtol: +1e-5, dt_max: 1. s, dt_min: .5 us }\n"));
  CHECK(scene.rendered() == "");
  const scene::YamlNode& integrator = *scene.tree.find("integrator");
  CHECK(scene::number_of(*integrator.find("dt"), scene.sources) == doctest::Approx(5e-4));
  CHECK(scene::number_of(*integrator.find("rtol"), scene.sources) == 1e-5);
  CHECK(scene::number_of(*integrator.find("dt_max"), scene.sources) == 1);
  CHECK(scene::number_of(*integrator.find("dt_min"), scene.sources) == doctest::Approx(5e-7));
}

TEST_CASE("overrides reach every value, by name and by number") {
  SceneText scene(kCloth, {"integrator.dt=5e-4", "bodies.cloth.mass=0.2",
                           "loads.vertex_drag.coefficient=1", "bodies.0.mesh.grid.patches=[3, 3]",
                           "fix.0.on_split=release", "output.fields.fall.name=speed",
                           "bodies.cloth.place.scale=2", "gravity=", "output.sync=true"});
  CHECK(scene.rendered() == "");
  CHECK(scene.tree.find("integrator")->find("dt")->text == "5e-4");
  const scene::YamlNode& body = scene.tree.find("bodies")->items[0];
  CHECK(body.find("mass")->text == "0.2");
  CHECK(body.find("mesh")->find("grid")->find("patches")->items[0].text == "3");
  CHECK(scene.tree.find("gravity") == nullptr);
  CHECK(SceneText(kCloth, {"bodies.cloth.mass.density=3"}).rendered() == "");

  const std::string unnamed = exchanged(kCloth, "- name: cloth\n    mesh", "- mesh");
  CHECK(SceneText(unnamed, {"bodies.body.mass=0.2"})
            .tree.find("bodies")
            ->items[0]
            .find("mass")
            ->text == "0.2");

  const auto wrong = [](const std::string& text) { return SceneText(kCloth, {text}).errors(); };
  CHECK(wrong("integrator.dt") == lines({"1:1 bad-override: `integrator.dt` is not PATH=VALUE"}));
  CHECK(wrong("integrator..dt=1").find("bad-override") != std::string::npos);
  CHECK(wrong("integrator.ddt=1") == lines({"1:12 unknown-key: there is no key `ddt` here"}));
  CHECK(wrong("integrator.dt=-1") == lines({"1:15 out-of-range: this must be above 0 s"}));
  CHECK(wrong("bodies.clot.mass=1") ==
        lines({"1:8 bad-override: no entry of this list is called `clot`"}));
  CHECK(wrong("bodies.3.mass=1") ==
        lines({"1:8 bad-override: the list has 1 entries, counted from 0"}));
  CHECK(wrong("seed=[").find("yaml-syntax") != std::string::npos);
}

TEST_CASE("every default of the schema is allowed by the schema, and every row is documented") {
  for (const scene::SchemaRow& row : scene::schema_rows()) {
    INFO(row.path);
    CHECK(!row.doc.empty());
    if (row.form == scene::Form::Choice && !row.fallback.empty() && !row.required()) {
      const auto words = scene::allowed_by(row).words;
      CHECK(std::find(words.begin(), words.end(), row.fallback) != words.end());
    }
    CHECK(scene::schema_documentation().find("`" + std::string(row.path) + "`") !=
          std::string::npos);
  }
}

TEST_CASE("mutations of a scene give errors or a tree, never a crash") {
  const std::string pieces[] = {"[", "]",  "{", "}",    ":",    ",",    "-",   "\n", "\"",
                                "'", "  ", "0", "true", "&a ",  "*a",   "|\n", ">",  "#",
                                "?", "!",  "%", "1 m",  "\xc3", "null", "*",   "- "};
  for (std::uint32_t seed = 0; seed < 3000; ++seed) {
    std::mt19937 random(seed);
    std::string text = kCloth;
    for (int k = 0; k < 1 + static_cast<int>(random() % 4); ++k) {
      const std::size_t at = random() % text.size();
      switch (random() % 3) {
        case 0:
          text.erase(at, random() % 12);
          break;
        case 1:
          text.insert(at, pieces[random() % std::size(pieces)]);
          break;
        default:
          text.insert(at, text.substr(random() % text.size(), random() % 40));
      }
    }
    INFO("seed " << seed);
    const SceneText scene(text);
    (void)scene.rendered();
    if (scene.diagnostics.has_errors()) continue;
    const SceneText again(scene::resolved_text(scene.tree));
    CHECK(again.rendered() == "");
    CHECK(scene::same_values(again.tree, scene.tree));
  }
}
