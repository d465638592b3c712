// SPDX-License-Identifier: MIT
// What an item looks like after checking: labels and links are numbers, sugar is gone.
#include <doctest/doctest.h>

#include <string>

#include "check_text.h"

namespace {

struct Row {
  int dimension;
  std::string text;
  std::string checked;
};

void check_rows(const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    CAPTURE(row.text);
    const auto checked = gmsim::check_tests::check_text(row.text);
    REQUIRE(checked.messages() == "");
    CHECK(checked.dump(row.dimension) == row.checked);
  }
}

}  // namespace

TEST_CASE("labels, links and ranges become numbers of the dimension") {
  const std::string separate =
      "rule s(a) { left { a<0..n-2> -n- b<0..n-2>; } right { a -n- a; b -n- b; } }";
  check_rows({
      {2, separate,
       "rule s(a)\n"
       "  left { a<0>; b<0>; a -2- b; }\n"
       "  right { a<0>; b<0>; a -2- a; b -2- b; }\n"},
      {3, separate,
       "rule s(a)\n"
       "  left { a<0,1>; b<0,1>; a -3- b; }\n"
       "  right { a<0,1>; b<0,1>; a -3- a; b -3- b; }\n"},
      {2, "rule r(a) { left { a<0>; b<0>; a -2- b; } }",
       "rule r(a)\n"
       "  left { a<0>; b<0>; a -2- b; }\n"},
      {3, "embedding e : real [mm] on <0..n-2, n> = 5;", "embedding e : real [m] on <0,1,3> = 0.005\n"},
      {2, "orbit tip = <2..n>; embedding e : int on tip = 1;", "embedding e : int on <2> = 1\n"},
  });
}

TEST_CASE("named patterns are expanded into paths") {
  check_rows({
      {2,
       "pattern t(a, b, c) { a -0.1- b -0.1- c -0.1- a; }"
       "interaction i on face(p) { match t(p, q, r); force p on corner = (0, 0, 0); }",
       "interaction i on <0,1>(p)\n"
       "  match { p<>; q<>; r<>; p -0.1- q; q -0.1- r; r -0.1- p; }\n"
       "  force p on <1> = (0, 0, 0)  : vec3 [N]\n"},
      // A node that is no parameter cannot collide with one outside.
      {2,
       "pattern across(a, b) { a -0- x -2- b; }"
       "criterion c on vertex(a) { match { across(a, b); across(b, x); } value 1; }",
       "criterion c on <1,2>(a)\n"
       "  match { a<>; b<>; across.x<>; x<>; across#2.x<>; a -0- across.x; across.x -2- b; "
       "b -0- across#2.x; across#2.x -2- x; }\n"
       "  param threshold : real\n"
       "  value 1  : real\n"},
  });
}

TEST_CASE("functions and macros are expanded with their arguments bound once") {
  check_rows({
      {2, "function twice(x) = x + x; rule r(a) { left { a; } where twice(a.mass * 2) > 0; }",
       "rule r(a)\n"
       "  left { a<>; }\n"
       "  where (let x = a.mass * 2; x + x) > 0\n"},
      // Names and walks stand where the parameter stood.
      {2, "function step_to(x) = x@0; rule r(a) { left { a; } where step_to(step_to(a@1)) == a; }",
       "rule r(a)\n"
       "  left { a<>; }\n"
       "  where a@1@0@0 == a\n"},
      {2,
       "operation o on vertex(a) { param k : real; let far(x) = x.mass > k * (1 [kg]);"
       " for x in vertex(a) / facet where far(x@0) { x.velocity = (0, 0, 0); } }",
       "operation o on <1,2>(a)\n"
       "  param k : real\n"
       "  for x in <1,2>(a) / <0,2> where x@0.mass > k * 1\n"
       "    x.velocity = (0, 0, 0)  : vec3 [m/s]\n"},
  });
}
