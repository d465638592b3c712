// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "check_text.h"

using gmsim::check_tests::check_text;

namespace {

/// "missing-value: …" for each message about a rule after some declarations, all in 2D.
std::vector<std::string> messages_of(const std::string& text) {
  const auto checked = check_text("dimension 2;\n" + text, false);
  std::vector<std::string> messages;
  for (const gmsim::support::Diagnostic& diagnostic : checked.diagnostics.all())
    messages.push_back(std::string(gmsim::support::name_of(diagnostic.kind)) + ": " +
                       diagnostic.message);
  return messages;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

struct Row {
  std::string text;
  std::vector<std::string> messages = {};
};

void check_rows(const std::string& declarations, const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    CAPTURE(row.text);
    CHECK(joined(messages_of(declarations + row.text)) == joined(row.messages));
  }
}

const std::string kSplit = "rule r(a) { left { a<0,2>; } right { a<_,2> -0- m<1,2>; } ";
const std::string kSew = "rule r(a, b) { left { a<0> -2- a; b<0> -2- b; } right { a -2- b; } ";

}  // namespace

TEST_CASE("E1: a created orbit needs a value or a default") {
  check_rows("embedding heat : real on vertex;\n",
             {{kSplit + "}",
               {"missing-value: `heat` has no value on the vertex that the rule creates at `m`"}},
              {kSplit + "m.heat = 0; }"},
              // The value of an old vertex says nothing about the new one.
              {kSplit + "a.heat = 1; }",
               {"missing-value: `heat` has no value on the vertex that the rule creates at `m`"}}});
  check_rows("embedding heat : real on vertex = 20;\n", {{kSplit + "}"}});
  check_rows("embedding heat : real on vertex optional;\n", {{kSplit + "}"}});
  check_rows(
      "embedding share : real on <1> extensive;\n",
      {{kSplit + "}",
        {"missing-value: `share` has no value on the orbit <1> that the rule creates at `m`"}}});
  // The faces stay what they were.
  check_rows("embedding heat : real on face;\n", {{kSplit + "}"}});
  check_rows("derived heat : real on vertex(a) = 1;\n", {{kSplit + "}"}});
  // An edge cut in two: each half has its end.
  check_rows("embedding heat : real on edge;\n", {{kSplit + "}"}});
}

TEST_CASE("E2: an orbit has one value") {
  check_rows(
      "embedding heat : real on edge;\n",
      {{kSew + "a.heat = 1; b.heat = 2; }",
        {"several-values: one edge is given two values: `a` and `b` lie in it"}},
       {kSew + "a.heat = 1; a.heat = 2; }", {"several-values: `a.heat` is given two values"}},
       {kSew + "a.heat = 1; }"},
       // The same value twice is one value.
       {kSew + "a.heat = a.heat + b.heat; b.heat = b.heat + a.heat; }"}});
  check_rows("embedding heat : real on <0>;\n", {{kSew + "a.heat = 1; b.heat = 2; }"}});
}

TEST_CASE("E3 and E4: joined orbits need a value or a policy") {
  check_rows("embedding heat : real on edge;\n",
             {{kSew + "}",
               {"unresolved-merge: the edge of `a` and that of `b` become one, each with its own "
                "`heat`"}},
              {kSew + "b.heat = 0.5 * (a.heat + b.heat); }"}});
  check_rows("embedding heat : real on edge merge mean;\n", {{kSew + "}"}});
  check_rows("embedding heat : real on edge extensive;\n", {{kSew + "}"}});
  check_rows("embedding heat : real on edge optional;\n",
             {{kSew + "}",
               {"unresolved-merge: the edge of `a` and that of `b` become one, each with its own "
                "`heat`"}}});
  // Two darts of one vertex, joined by a path, may be linked within it.
  check_rows("embedding heat : real on face;\n",
             {{"rule r(a) { left { a -0.1- b; } right { a; b; } }"}});
  // The dual joins the vertices around a face.
  check_rows("embedding heat : real on vertex;\n",
             {{"rule dual(a) { left { a<0,1,2>; } right { a<2,1,0>; } }",
               {"unresolved-merge: vertices of `a` that were apart become one, each with its own "
                "`heat`"}},
              {"rule dual(a) { left { a<0,1,2>; } right { a<2,1,0>; } "
               "a.heat = mean(x in face(a) / vertex : x.heat); }"}});
  // Cutting only takes apart.
  check_rows("embedding heat : real on vertex;\n",
             {{"rule cut(a) { left { a<0> -2- b<0>; } right { a -2- a; b -2- b; } }"}});
}

TEST_CASE("E6: a value is the same from every dart of its orbit") {
  const auto split = [](const std::string& value) { return kSplit + "m.heat = " + value + "; }"; };
  const std::string heat =
      "embedding heat : real on vertex;\nembedding at : vec3 on vertex merge mean = (0, 0, 0);\n";
  for (const std::string value :
       {"0.5 * (a.heat + a@0.heat)",
        "a.heat + 0.5 * (a@0.heat - a.heat)",
        "a.heat * a@0.heat",
        "a.heat / 2 + a@0.heat / 2",
        "(a.heat - a@0.heat)^2",
        "abs(a.heat - a@0.heat)",
        "norm(a@0.at - a.at)",
        "dot(a.at, a@0.at)",
        "norm(cross(a.at, a@0.at))",
        "min(a.heat, a@0.heat)",
        "max(1, max(a@0.heat, a.heat))",
        "a@2@0.heat + a@2.heat",
        "a@0@1.heat + a@1.heat",
        "mean(x in edge(a) / vertex : x.heat)",
        "sum(x in face(a) / vertex : x.heat) + sum(x in face(a@2) / vertex : x.heat)",
        "if a.heat == a@0.heat then 1 else 2",
        "count(x in edge(a))",
        "if free(a, 2) then 1 else 2",
        "sum(x in polygon(a) : x.heat) + sum(x in polygon(a@2) : x.heat)",
        "norm(sum(x in polygon(a) : cross(x.at, x@0.at)) - sum(x in polygon(a@2) : cross(x.at, "
        "x@0.at)))",
        "norm(normalize(a.at - a@0.at))",
        "1"}) {
    CAPTURE(value);
    CHECK(joined(messages_of(heat + split(value))) == "");
  }
  for (const std::string value :
       {"a.heat", "a.heat - a@0.heat", "(a.heat - a@0.heat)^3", "a.heat + 2 * a@0.heat",
        "mean(x in face(a) / vertex : x.heat)", "sum(x in vertex(a) : x.heat)",
        "if a.heat > a@0.heat then a.heat else a@0.heat", "if free(a, 1) then 1 else 2",
        "sum(x in polygon(a) : x.heat)", "(a.at - a@0.at).x", "random(1, vertex(a))"}) {
    CAPTURE(value);
    const std::vector<std::string> messages = messages_of(heat + split(value));
    CHECK(joined(messages) ==
          "not-invariant: the value of `m.heat` depends on the dart of the vertex that it is "
          "evaluated at\n");
  }
}

TEST_CASE("E6 looks through let and function") {
  const std::string heat =
      "embedding heat : real on vertex;\nfunction ends(a) = a.heat + a@0.heat;\n";
  check_rows(heat, {{kSplit + "let s = ends(a); m.heat = s / 2; }"},
                    {kSplit + "let near = a.heat; let far = a@0.heat; m.heat = near * far; }"},
                    {kSplit + "let near = a.heat; m.heat = near; }",
                     {"not-invariant: the value of `m.heat` depends on the dart of the vertex that "
                      "it is evaluated at"}}});
}

TEST_CASE("E6 uses the links of the match") {
  // `b` is the other side: its darts are those of `a` over link 2.
  const std::string heat =
      "embedding heat : real on edge merge mean;\nembedding up : real on vertex merge mean;\n";
  check_rows(heat,
             {{"rule r(a) { left { a<0> -2- b<0>; } right { a -2- b; } a.heat = a.up + b@0.up; }"},
              {"rule r(a) { left { a<0> -2- b<0>; } right { a -2- b; } a.heat = a.up; }",
               {"not-invariant: the value of `a.heat` depends on the dart of the edge that it is "
                "evaluated at"}},
              // A single dart has one row.
              {"rule r(a) { left { a -0- b; } right { a -0- b; } a.heat = a.up; }"}});
}

TEST_CASE("the message of E6 shows both forms") {
  const auto checked = check_text(
      "rule split(a) {\n"
      "    dimension 2;\n"
      "    left  { a<0,2>; }\n"
      "    right { a<_,2> -0- m<1,2>; }\n"
      "    m.position = a.position;\n"
      "    m.corner_mass = 0;\n"
      "}\n");
  CHECK(
      checked.messages() ==
      "error: the value of `m.position` depends on the dart of the vertex that it is evaluated at "
      "[not-invariant]\n"
      " --> my.rule:5:18\n"
      "  |\n"
      "5 |     m.position = a.position;\n"
      "  |                  ^^^^^^^^^^\n"
      "note: moving along link 0 gives `a@0.position` instead of `a.position`\n"
      "help: write a value that is the same from every such dart, for example a mean or a sum "
      "over them\n");
}

TEST_CASE("library-like rules are accepted") {
  const auto checked = check_text(R"(
rule separate_elements(a) { left { a<0..n-2> -n- b<0..n-2>; } right { a -n- a; b -n- b; } }
rule sew_elements(a, b) { left { a<0..n-2> -n- a; b<0..n-2> -n- b; } right { a -n- b; } }
rule delete_element(a) { left { a<0..n-1> -n- a; } right { } }
rule insert_vertex(a) {
    left  { a<0,2..n>; }
    right { a<_,2..n> -0- m<1,2..n>; }
    m.position = 0.5 * (a.position + a@0.position);
    m.velocity = 0.5 * (a.velocity + a@0.velocity);
    m.corner_mass = 0.25 * (a.corner_mass + a@0.corner_mass);
    a.corner_mass = 0.5 * a.corner_mass;
}
rule triangulate_face(a) {
    dimension 2;
    left  { a<0,1>; }
    right { a<0,_> -1- b<_,2> -0- c<1,2>; }
    c.position = mean(x in face(a) / corner : x.position);
    c.velocity = mean(x in face(a) / corner : x.velocity);
}
rule dual(a) {
    dimension 2;
    left { a<0,1,2>; } right { a<2,1,0>; }
    a.position = mean(x in face(a) / vertex : x.position);
    a.velocity = mean(x in face(a) / vertex : x.velocity);
}
rule yield(a) {
    left { a -0- b; }
    a.position = 0.5 * (a.position + b.position);
}
)");
  CHECK(checked.messages() == "");
}
