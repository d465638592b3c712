// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "check/passes.h"
#include "check_text.h"
#include "support/library_schemes.h"
#include "support/scheme_text.h"

using namespace gmsim;
using tests::rule_from_text;

namespace {

/// "incident-arcs: node `b` …" for each message.
std::vector<std::string> topology_messages(const check::Rule& rule) {
  support::Diagnostics diagnostics;
  const bool good = check::check_topology(rule, diagnostics);
  CHECK(good == !diagnostics.has_errors());
  std::vector<std::string> messages;
  for (const support::Diagnostic& diagnostic : diagnostics.all())
    messages.push_back(std::string(support::name_of(diagnostic.kind)) + ": " + diagnostic.message);
  return messages;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

struct Row {
  const char* scheme;
  int dimension;
  std::vector<std::string> messages;
};

void check_rows(const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    const std::string scheme = row.scheme;
    CAPTURE(scheme);
    CHECK(joined(topology_messages(rule_from_text(scheme, row.dimension))) == joined(row.messages));
  }
}

}  // namespace

TEST_CASE("known operations are accepted without a word") {
  for (const tests::NamedScheme& scheme : tests::sound_schemes()) {
    const std::string name = scheme.name;
    CAPTURE(name);
    CHECK(topology_messages(rule_from_text(scheme.text, scheme.dimension)).empty());
  }
}

TEST_CASE("operations that break some maps are rejected") {
  for (const tests::NamedScheme& scheme : tests::unsound_schemes()) {
    const std::string name = scheme.name;
    CAPTURE(name);
    CHECK(!topology_messages(rule_from_text(scheme.text, scheme.dimension)).empty());
  }
}

TEST_CASE("C1 to C6: what a pattern must be") {
  check_rows({
      {"a*<0 3> => a<0 3>",
       2,
       {"link-dimension: a label names dimension 3 in a map of dimension 2"}},
      {"a*<0> | a-3-a => a<0> | a-3-a",
       2,
       {"link-dimension: a link names dimension 3 in a map of dimension 2",
        "link-dimension: a link names dimension 3 in a map of dimension 2"}},
      {"a*<0> a<0> | a-2-a =>", 2, {"duplicate-node: node `a` stands twice in `left`"}},
      {"a*<0> b<0 1> | a-2-b => a<0> | a-2-a",
       2,
       {"label-length: node `b` has a label of 2 entries, but `a` has a label of 1 entry"}},
      {"a*<0> => a<0> b<>",
       2,
       {"label-length: node `b` has no label, but `a` has a label of 1 entry"}},
      {"=> a<0>",
       2,
       {"label-length: node `a` has a label of 1 entry, but `left` has no node whose orbit it "
        "could "
        "copy"}},
      {"a*<0 _> => a<0 _>", 2, {"hook-label: the label of hook `a` holds `_`"}},
      {"a*<0> b<0> => a<0> b<0>",
       2,
       {"hook-count: node `b` of `left` is not reached from any hook"}},
      {"a*<0> b*<0> | a-2-b => a<0> b<0> | a-2-b",
       2,
       {"hook-count: hooks `a` and `b` stand in one connected part of `left`"}},
      {"a*<0> | a-0-a => a<0>", 2, {"duplicate-dimension: node `a` has two 0-links in `left`"}},
      {"a*<0> b<0> | a-2-a a-2-b => a<0> b<0> | a-2-b",
       2,
       {"duplicate-dimension: node `a` has two 2-links in `left`"}},
  });
}

TEST_CASE("C7: what becomes of the links of a node") {
  check_rows({
      {"a*<0> b<0> | a-2-b => a<0> b<0> | a-2-a",
       2,
       {"incident-arcs: node `b` has a 2-link in `left` and none in `right`"}},
      // An arc that is gone at both ends is one mistake.
      {"a*<0> b<0> | a-2-b => a<0> b<0>",
       2,
       {"incident-arcs: node `a` has a 2-link in `left` and none in `right`"}},
      {"a*<0 2> => a<_ 2>",
       2,
       {"incident-arcs: node `a` has a 0-link in `left` and none in `right`"}},
      {"a*<0> => a<0> | a-2-a",
       2,
       {"incident-arcs: node `a` has a 2-link in `right` and none in `left`"}},
      {"a*<0> =>", 2, {"incident-arcs: node `a` is removed, but not its 1- and 2-links"}},
      {"a*<0> | a-2-a => a<0> b<0> | a-2-b",
       2,
       {"incident-arcs: node `b` is created without its 1-link"}},
      // Two mistakes in one rule.
      {"a*<0> b*<0> | a-2-a => a<0> b<0>",
       2,
       {"incident-arcs: node `a` has a 2-link in `left` and none in `right`"}},
      {"a*<0> b*<0> | a-2-a b-2-b => a<0> | a-2-a",
       2,
       {"incident-arcs: node `b` is removed, but not its 1-link"}},
  });
}

TEST_CASE("C8: squares stay closed") {
  check_rows({
      {"a*<> d<> | a-2-d => a<> d<> | a-2-a d-2-d",
       2,
       {"broken-cycle: the rule changes the 2-link of node `a` but not that of its 0-neighbour",
        "broken-cycle: the rule changes the 2-link of node `d` but not that of its 0-neighbour"}},
      {"a*<0 1> => a<1 0>",
       2,
       {"broken-cycle: the rule changes the 0-link of node `a` but not that of its 2-neighbour"}},
      {"a*<0 2 3> b<_ _ 3> | a-1-b => b<_ 1 3>",
       3,
       {"broken-cycle: links 1 and 3 of node `b` no longer commute after the rule"}},
      // Positions 0 and 1 commute at `b` alone.
      {"a*<0 1> b<0 2> | a-3-b => a<0 1> b<2 0> | a-3-b",
       3,
       {"broken-cycle: links 0 and 3 of node `b` no longer commute after the rule"}},
      {"a*<0 2> b*<0 1> => a<2 0> b<0 1>", 2, {}},
      {"a*<0 1> b*<0 2> => a<0 1> b<2 0>", 2, {}},
      // Relocated labels, with a changed arc between relocated nodes.
      {"a*<0 2> b<0 2> | a-1-b => a<2 0> b<2 0> | a-1-b", 2, {}},
      // Arcs that are left alone although the squares over them are not matched.
      {"a*<> b<> c<> | a-0-b b-2-c => a<> b<> c<> | a-0-b b-2-c", 2, {}},
      {"a*<> b<> | a-0-b a-2-a => a<> b<> | a-0-b a-2-a", 2, {}},
  });
}

TEST_CASE("a link that follows from the others is used, and named in a warning") {
  struct Implied {
    const char* scheme;
    const char* help;
  };
  const std::vector<Implied> rows{
      {"a*<> b<> c<> d<> | a-0-b a-2-d b-2-c => a<> b<> c<> d<> | a-0-b a-2-a b-2-b c-2-c d-2-d",
       "write `c -0- d` in `left` and `right`"},
      {"a*<> b<> c<> d<> | d-0-c a-2-d b-2-c => a<> b<> c<> d<> | a-0-b d-0-c a-2-a b-2-b c-2-c "
       "d-2-d",
       "write `a -0- b` in `left`"},
      {"a*<0> b<_> | a-2-b => a<0> b<_> | a-2-a b-2-b", "write `b<0>` in `left` and `right`"},
  };
  for (const Implied& row : rows) {
    const std::string scheme = row.scheme;
    CAPTURE(scheme);
    support::Diagnostics diagnostics;
    CHECK(check::check_topology(rule_from_text(row.scheme, 2), diagnostics));
    REQUIRE(diagnostics.all().size() == 1);
    CHECK(diagnostics.all()[0].kind == support::DiagnosticKind::ImpliedLink);
    CHECK(diagnostics.all()[0].severity == support::Severity::Warning);
    CHECK(diagnostics.all()[0].help == row.help);
  }
}

TEST_CASE("what follows can also forbid") {
  check_rows({
      // d's 0-link leads to c, which keeps it.
      {"a*<> b<> c<> d<> | a-0-b a-2-d b-2-c => a<> b<> c<> d<> | a-0-b a-2-d b-2-c d-0-d",
       2,
       {"incident-arcs: the 0-link of `d` leads to `c`, which keeps it while `d` changes it"}},
      {"a*<> b<> c<> d<> e<> | a-0-b a-2-d b-2-c d-0-e =>",
       2,
       {"conflict: `left` matches nowhere: `d -0- e` and `d -0- c` both follow from its links"}},
      // Position 0 leads nowhere else: wherever this matches, `a` is 0-free.
      {"a*<0> b<_> | a-2-b b-0-b => a<_> b<_> | a-2-b b-0-b a-0-a", 2, {}},
  });
}

TEST_CASE("paths connect a match and are no links of their nodes") {
  check::Rule rule = rule_from_text("a*<> b<> | a-2-a b-2-b => a<> b<>  | a-2-b", 2);
  const std::vector<std::string> apart = topology_messages(rule);
  REQUIRE(!apart.empty());
  CHECK(apart.front() == "hook-count: node `b` of `left` is not reached from any hook");
  rule.left.paths.push_back({{0, 1}, 0, 1, {}});
  const std::vector<std::string> joined = topology_messages(rule);
  REQUIRE(joined.size() == 1);
  CHECK(joined.front().starts_with("broken-cycle"));
  rule.right.paths.push_back({{0, 1}, 0, 1, {}});
  CHECK(topology_messages(rule).front() ==
        "path-in-right: a path of several links stands in `right`");
}

TEST_CASE("a rule without right is only matched") {
  CHECK(topology_messages(rule_from_text("a*<> b<> | a-0-b", 2)).empty());
  CHECK(topology_messages(rule_from_text("a*<> b<>", 2)).size() == 1);
}

TEST_CASE("the match of an interaction is rooted at its dart") {
  const auto messages = [](const char* text, check::NodeIndex hook) {
    support::Diagnostics diagnostics;
    check::check_match(rule_from_text(text, 2).left, hook, 2, diagnostics);
    std::vector<std::string> list;
    for (const support::Diagnostic& diagnostic : diagnostics.all())
      list.push_back(diagnostic.message);
    return list;
  };
  CHECK(messages("a<> b<> | a-0-b", 0).empty());
  CHECK(messages("a<> b<> | a-0-b", 1).empty());
  CHECK(messages("a<> b<> c<> | a-0-b", 0) ==
        std::vector<std::string>{"node `c` of `match` is not reached from any hook"});
  CHECK(messages("a<> b<> | a-3-b", 0).size() == 1);
  CHECK(messages("a<> b<> c<> | a-0-b b-0-c", 0).size() == 1);
}

TEST_CASE("messages point at the place, the reason and the fix") {
  const auto checked = check_tests::check_text(
      "rule cut(a) {\n"
      "    dimension 2;\n"
      "    left  { a<0> -2- b<0>; }\n"
      "    right { a -2- a; b; }\n"
      "}\n");
  CHECK(checked.messages() ==
        "error: node `b` has a 2-link in `left` and none in `right` [incident-arcs]\n"
        " --> my.rule:4:22\n"
        "  |\n"
        "3 |     left  { a<0> -2- b<0>; }\n"
        "  |                  --- 2-link of `b`\n"
        "4 |     right { a -2- a; b; }\n"
        "  |                      ^\n"
        "help: write `b -2- b` to leave `b` 2-free, or keep `a -2- b`\n");
}
