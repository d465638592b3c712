// SPDX-License-Identifier: MIT
// What a message says besides its kind and place.
#include <doctest/doctest.h>

#include <string>

#include "check_text.h"

using gmsim::check_tests::check_text;

TEST_CASE("a misspelt embedding comes with what the other one is and where it is declared") {
  CHECK(check_text("criterion c on vertex(a) {\n    value norm(a.velocty);\n}\n").messages() ==
        "error: no embedding named `velocty` [unknown-embedding]\n"
        " --> my.rule:2:18\n"
        "  |\n"
        "2 |     value norm(a.velocty);\n"
        "  |                  ^^^^^^^\n"
        "help: did you mean `velocity` (vec3 [m/s], on vertex, declared in particles.rule:3)?\n");
}

TEST_CASE("a name of another kind is told apart from one that is not known") {
  const auto help = [](const std::string& text) {
    const auto checked = check_text(text);
    REQUIRE(checked.diagnostics.all().size() == 1);
    return checked.diagnostics.all()[0].help;
  };
  CHECK(help("rule r(a) { left { a; } where position == 0; }") ==
        "`position` is read at a dart, as in `a.position`");
  CHECK(help("function f(a) = norm;") == "`norm` is a function; write `norm(…)`");
  CHECK(help("rule r(a) { left { a; } where r(a); }") == "`r` is a rule");
  CHECK(help("rule r(a) { left { a; } where a.position * a.position == 0; }") ==
        "write `dot(…)`, `cross(…)` or `outer(…)`");
  CHECK(help("rule r(a) { left { a; } where vertex(a).mass > 0; }") ==
        "go over its darts, as in `mean(x in … : x.mass)`");
}

TEST_CASE("a mistake inside of a function is shown at the call, with the place inside") {
  const auto checked =
      check_text("function length(v) = norm(v) + 1;\n"
                 "rule r(a) { left { a; } where length(a.mass) > 1 [m]; }\n"
                 "rule q(a) { left { a; } where length(a) > 1 [m]; }\n");
  CHECK(checked.messages() ==
        "error: this compares [kg] and [m] [unit-mismatch]\n"
        " --> my.rule:2:46\n"
        "  |\n"
        "2 | rule r(a) { left { a; } where length(a.mass) > 1 [m]; }\n"
        "  |                                              ^ ----- [m]\n"
        "  |                               -------------- [kg]\n"
        "\n"
        "error: `norm` cannot take a dart [type-mismatch]\n"
        " --> my.rule:3:31\n"
        "  |\n"
        "1 | function length(v) = norm(v) + 1;\n"
        "  |                           - in `length`\n"
        "2 | rule r(a) { left { a; } where length(a.mass) > 1 [m]; }\n"
        "3 | rule q(a) { left { a; } where length(a) > 1 [m]; }\n"
        "  |                               ^^^^^^^^^\n"
        "help: it is `norm(vec3)` or `norm(vec2)` or `norm(real)`\n");
}
