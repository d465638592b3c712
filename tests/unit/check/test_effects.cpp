// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <string>

#include "check_text.h"
#include "types/orbit_type.h"

using namespace gmsim;
using check_tests::check_text;

namespace {

std::string names(const check::RuleLibrary& library, const std::vector<types::EmbeddingId>& ids) {
  std::string text;
  for (const types::EmbeddingId id : ids)
    text += (text.empty() ? "" : " ") + library.schema[id].name;
  return text;
}

std::string in_words(const check::RuleLibrary& library, const check::Footprint& footprint) {
  return "reads " + names(library, footprint.reads) + " over " +
         types::to_string(footprint.reads_links) + ", writes " + names(library, footprint.writes) +
         " and links " + types::to_string(footprint.writes_links) +
         (footprint.creates_darts ? ", creates" : "") +
         (footprint.removes_darts ? ", removes" : "") + (footprint.reads_forces ? ", forces" : "") +
         (footprint.reads_time ? ", time" : "");
}

}  // namespace

TEST_CASE("footprints of rules") {
  const auto checked = check_text(R"(
dimension 2;
rule cut(a) { left { a<0> -2- b<0>; } right { a -2- a; b -2- b; } }
rule split(a) {
    left { a<0,2>; } right { a<_,2> -0- m<1,2>; }
    m.position = 0.5 * (a.position + a@0.position); m.corner_mass = 0;
}
rule drop(a) { left { a<0,1> -2- a; } right { } where time > 1; }
rule push(a) { left { a -0- b; } let v = mean(x in face(a) / vertex : x.velocity); a.velocity = v; }
)");
  const check::RuleLibrary& library = checked.rules.in(2);
  const auto of = [&](const char* name) {
    const check::Rule* rule = library.find_rule(name);
    return rule == nullptr ? "none: " + checked.messages() : in_words(library, rule->footprint);
  };
  CHECK(of("cut") == "reads  over <0,2>, writes  and links <2>");
  CHECK(of("split") ==
        "reads position over <0,2>, writes position corner_mass and links <0,1,2>, creates");
  CHECK(of("drop") == "reads  over <0,1,2>, writes  and links <0,1,2>, removes, time");
  CHECK(of("push") == "reads velocity over <0,1,2>, writes velocity and links <>");
}
