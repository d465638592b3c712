// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "parsed.h"
#include "samples.h"

using namespace gmsim::syntax;

TEST_CASE("items have the tree that is written") {
  for (const Sample& sample : kItems) {
    CAPTURE(sample.source);
    const ParsedFile parsed{std::string(sample.source)};
    CHECK(parsed.messages() == "");
    CHECK(parsed.tree() == sample.tree);
  }
}

TEST_CASE("items, statements and links span their text") {
  const ParsedFile parsed{
      "/// Doc.\nrule r(a) {\n  left { a<0> -0.1- b; }\n  a.x = 1;\n}\nfamily f = g;"};
  REQUIRE(parsed.messages() == "");
  REQUIRE(parsed.file.items.size() == 2);
  const auto text = [&](gmsim::support::Span span) { return parsed.sources.text(span); };
  CHECK(text(parsed.file.items[0].span).starts_with("rule r(a) {"));
  CHECK(text(parsed.file.items[0].span).ends_with("}"));
  CHECK(text(parsed.file.items[1].span) == "family f = g;");

  const auto& rule = std::get<RuleItem>(parsed.file.items[0].node);
  CHECK(text(rule.hooks.at(0).span) == "a");
  CHECK(text(rule.body.at(0).span) == "left { a<0> -0.1- b; }");
  CHECK(text(rule.body.at(1).span) == "a.x = 1;");
  const PatternBlock& block = std::get<SideStatement>(rule.body.at(0).node).block;
  CHECK(text(block.span) == "{ a<0> -0.1- b; }");
  CHECK(text(block.statements.at(0).span) == "a<0> -0.1- b");
  const auto& chain = std::get<Chain>(block.statements.at(0).node);
  CHECK(text(chain.links.at(0).span) == "-0.1-");
  CHECK(text(chain.links.at(0).path.at(0).span) == "0");
  CHECK(text(chain.links.at(0).path.at(1).span) == "1");
  REQUIRE(chain.nodes.at(0).label);
  CHECK(text(chain.nodes.at(0).label->span) == "<0>");
}

TEST_CASE("a path through n-1 spans each of its dimensions") {
  const ParsedFile parsed{"pattern p(a, b) { a -2.n-1.0- b; }"};
  REQUIRE(parsed.messages() == "");
  const auto& pattern = std::get<PatternItem>(parsed.file.items.at(0).node);
  const auto& path = std::get<Chain>(pattern.block.statements.at(0).node).links.at(0).path;
  REQUIRE(path.size() == 3);
  CHECK(parsed.sources.text(path[0].span) == "2");
  CHECK(parsed.sources.text(path[1].span) == "n-1");
  CHECK(parsed.sources.text(path[2].span) == "0");
  CHECK(path[1].from_top);
  CHECK(path[1].in(3) == 2);
  CHECK_FALSE(path[2].from_top);
}

TEST_CASE("the lines of a doc comment belong to the item below them") {
  const ParsedFile parsed{
      "/// first\nfamily a = b;\n// plain\nfamily c = d;\n/// third\n\n/// still third\r\n"
      "family e = f;\nrule r(a) {\n  /// of no item\n  let x = 1;\n}\nfamily g = h;\n/// last\n"};
  REQUIRE(parsed.file.items.size() == 5);
  CHECK(parsed.file.items[0].doc == "first\n");
  CHECK(parsed.file.items[1].doc == "");
  CHECK(parsed.file.items[2].doc == "third\nstill third\n");
  CHECK(parsed.file.items[3].doc == "");
  CHECK(parsed.file.items[4].doc == "");
}
