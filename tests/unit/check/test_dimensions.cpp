// SPDX-License-Identifier: MIT
// One text for maps of dimension 1, 2 and 3.
#include <doctest/doctest.h>

#include <string>

#include "check_text.h"

using namespace gmsim;
using gmsim::check_tests::check_text;

TEST_CASE("an item that names what a dimension lacks is absent there") {
  const auto checked = check_text(
      "embedding density : real on volume = 1;"
      "function heavy(a) = a.density > 2;"
      "rule r(a) { left { a<0,1> -3- a; } where heavy(a); }"
      "interaction i on volume(a) { force a on vertex = (0, 0, 0); }"
      "operation o on vertex(a) { apply r(a); }");
  CHECK(checked.messages() == "");
  CHECK(checked.rules.in(3).find_rule("r") != nullptr);
  CHECK(checked.rules.in(3).find_operation("o") != nullptr);
  CHECK(checked.rules.in(2).find_rule("r") == nullptr);
  CHECK(checked.rules.in(2).schema.find("density") == std::nullopt);
  CHECK(checked.rules.in(2).interactions.empty());
  CHECK(checked.rules.why_absent("density", 2) == "there is no orbit `volume` in dimension 2");
  CHECK(checked.rules.why_absent("r", 2) == "there is no link 3 in dimension 2");
  CHECK(checked.rules.why_absent("o", 2) ==
        "rule `r` does not exist in dimension 2: there is no link 3 in dimension 2");
  CHECK(checked.rules.why_absent("r", 3) == "");
}

TEST_CASE("absence spreads to what reads the item, however late it is found") {
  // That `a` is absent shows only inside of its body, after `b` was looked at.
  const auto checked = check_text(
      "interaction b on vertex(v) { force v on vertex = v.a.size * (1, 0, 0); }"
      "interaction a on vertex(v) { param size : real = 1; force v on vertex = v@3.velocity * 0; }");
  REQUIRE(checked.diagnostics.error_count() == 1);
  const auto other = check_text(
      "interaction b on vertex(v) { force v on vertex = v.a.size * (1, 0, 0); }"
      "interaction a on vertex(v) { param size : real = 1;"
      " force v on vertex = if free(v, 3) then (0, 0, 0) else (1, 0, 0); }");
  CHECK(other.messages() == "");
  CHECK(other.rules.in(2).interactions.empty());
  CHECK(other.rules.in(2).schema.find("a.size") == std::nullopt);
  CHECK(other.rules.in(3).interactions.size() == 2);
  for (const auto& interaction : other.rules.in(3).interactions)
    CHECK(other.rules.in(3).schema[interaction.presence].name == interaction.name);
}

TEST_CASE("an item that exists nowhere is an error") {
  CHECK(check_text("rule r(a) { dimension 2; left { a -3- a; } }").errors() ==
        std::vector<std::string>{"link-dimension|3"});
  CHECK(check_text("embedding e : real on <5> = 0;").errors() ==
        std::vector<std::string>{"link-dimension|5"});
  CHECK(check_text("dimension 2; embedding e : real on volume = 0;").errors() ==
        std::vector<std::string>{"dimension|volume"});
  CHECK(check_text("rule r(a) { left { a; } where free(a@4, 0); }").errors() ==
        std::vector<std::string>{"dimension|4"});
}

TEST_CASE("a mistake of both dimensions is reported once, of one dimension with a note") {
  const auto both = check_text("rule r(a) { left { a; } where a.positon == 0; }");
  REQUIRE(both.diagnostics.all().size() == 1);
  CHECK(both.diagnostics.all()[0].notes.empty());
  const auto one =
      check_text("rule r(a) { left { a; } where if n == 3 then a.positon == 0 else true; }");
  REQUIRE(one.diagnostics.all().size() == 1);
  CHECK(one.diagnostics.all()[0].notes == std::vector<std::string>{"in dimension 3"});
  // Where an item can be in one dimension only, the note would say nothing new.
  const auto only = check_text("rule r(a) { dimension 3; left { a; } where a.positon == 0; }");
  REQUIRE(only.diagnostics.all().size() == 1);
  CHECK(only.diagnostics.all()[0].notes.empty());
}

TEST_CASE("the branch that a dimension does not take is not looked at") {
  const auto checked = check_text(
      "function height(a) = if n == 2 then a.position.y else a@3.position.z;"
      "rule r(a) { left { a; } where height(a) > 0 and (n == 2 or free(a, 3)); }"
      "operation o on vertex(a) { if n == 3 { for x in volume(a) / face { apply r(x); } }"
      " else { apply r(a); } }");
  CHECK(checked.messages() == "");
  CHECK(checked.dump(2) ==
        "rule r(a)\n"
        "  left { a<>; }\n"
        "  where a.position.y > 0\n"
        "operation o on <1,2>(a)\n"
        "  apply r(a)\n");
  CHECK(checked.dump(3) ==
        "rule r(a)\n"
        "  left { a<>; }\n"
        "  where a@3.position.z > 0 and free(a, 3)\n"
        "operation o on <1,2,3>(a)\n"
        "  for x in <0,1,2>(a) / <0,1,3>\n"
        "    apply r(x)\n");
}

TEST_CASE("one name may have an item for each dimension") {
  const auto checked = check_text(
      "rule r(a) { dimension 2; left { a<0>; } } rule r(a) { dimension 3; left { a<0,1>; } }");
  CHECK(checked.messages() == "");
  CHECK(checked.rules.in(2).find_rule("r")->left.nodes[0].label.size() == 1);
  CHECK(checked.rules.in(3).find_rule("r")->left.nodes[0].label.size() == 2);
  CHECK(checked.rules.why_absent("r", 2) == "");
}

TEST_CASE("dimension 1 drops what does not check there without a word") {
  const auto checked = check_text("rule r(a) { left { a<0,2..n>; } }");
  CHECK(checked.messages() == "");
  const auto alone = check_text("rule r(a) { dimension 1; left { a; } where a.positon == 0; }");
  CHECK(alone.errors() == std::vector<std::string>{"unknown-embedding|positon"});
}

TEST_CASE("what depends on a mistake is silent") {
  const auto checked = check_text(
      "embedding e : reel on vertex = 0;"
      "function f(a) = a.e * 2;"
      "rule r(a) { left { a; } where f(a) > 0; a.e = 3; }"
      "operation o on vertex(a) { apply r(a); }");
  CHECK(checked.errors() == std::vector<std::string>{"unknown-type|reel"});
  CHECK(checked.rules.in(2).find_rule("r") == nullptr);
}

TEST_CASE("a text that does not parse hides the names that may be in it") {
  const auto checked = check_text("function f(a = 1; rule r(a) { left { a; } where f(a) > 0; }");
  for (const auto& diagnostic : checked.diagnostics.all())
    CHECK(diagnostic.kind == gmsim::support::DiagnosticKind::Syntax);
}

TEST_CASE("who asks for one dimension gets the library there; what users write is checked in all") {
  check::LibraryOptions options;
  options.dimension = 2;
  support::SourceMap sources;
  support::Diagnostics diagnostics;
  const check::CheckedRules library = check::check_texts({}, options, sources, diagnostics);
  const check::CheckedRules all = check::check_texts({}, {}, sources, diagnostics);
  CHECK(diagnostics.all().empty());
  CHECK(library.in(2).rules.size() > 0);
  CHECK(library.in(2).rules.size() == all.in(2).rules.size());
  CHECK(library.why_absent("cone_volume", 2) == all.why_absent("cone_volume", 2));
  CHECK(library.in(3).rules.empty());

  const support::FileId own = sources.add(
      "own.rule", "dimension 3;\nrule own(a) { left { a<0,1,2,3>; } where a.nothing > 0; }\n");
  const check::CheckedRules both = check::check_texts({own}, options, sources, diagnostics);
  CHECK(diagnostics.error_count() == 1);
  CHECK(both.in(3).rules.size() == all.in(3).rules.size());
}
