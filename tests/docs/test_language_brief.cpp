// SPDX-License-Identifier: MIT
// Files written like those in language_brief/ must be accepted, today and later; what the language
// refuses by design stands in the files called *_refused.rule.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "docs/check_text.h"

namespace gmsim::test {
namespace {

const std::string kFolder = "tests/docs/language_brief";

std::vector<NamedText> rule_texts(bool refused) {
  std::vector<NamedText> texts;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".rule" || name.ends_with("_refused.rule") != refused) continue;
    texts.push_back({name, read_file(entry.path().string())});
  }
  std::sort(texts.begin(), texts.end(),
            [](const NamedText& a, const NamedText& b) { return a.name < b.name; });
  return texts;
}

TEST_CASE("each file is accepted beside the library") {
  for (const NamedText& text : rule_texts(false)) {
    const CheckOutcome outcome = check_rule_texts({text});
    CHECK_MESSAGE(outcome.error_kinds.empty(), text.name, "\n", outcome.rendered);
  }
}

TEST_CASE("all files together need no library") {
  const CheckOutcome outcome = check_rule_texts(rule_texts(false), false);
  CHECK_MESSAGE(outcome.error_kinds.empty(), outcome.rendered);
}

TEST_CASE("what breaks a map is refused") {
  for (const NamedText& text : rule_texts(true)) {
    const CheckOutcome outcome = check_rule_texts({text});
    CHECK_MESSAGE(outcome.error_kinds == std::set<std::string>{"broken-cycle"}, text.name, "\n",
                  outcome.rendered);
  }
}

TEST_CASE("the expressions of a scene are accepted") {
  std::istringstream lines(read_file(kFolder + "/7_scene_expressions.txt"));
  for (std::string line; std::getline(lines, line);) {
    const CheckOutcome outcome = check_scene_expression({line, line}, 2);
    CHECK_MESSAGE(outcome.error_kinds.empty(), line, "\n", outcome.rendered);
  }
}

}  // namespace
}  // namespace gmsim::test
