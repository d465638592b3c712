// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "parsed.h"

using namespace gmsim;
using namespace gmsim::syntax;

namespace {

std::vector<std::string> error_lines(const ParsedFile& parsed) {
  std::vector<std::string> lines;
  for (const auto& diagnostic : parsed.diagnostics.all()) {
    const auto at = parsed.sources.locate(parsed.id, diagnostic.place->begin);
    lines.push_back(std::to_string(at.line));
  }
  return lines;
}

std::string item_names(const ParsedFile& parsed) {
  std::string names;
  for (const Item& item : parsed.file.items) {
    const auto& family = std::get_if<FamilyItem>(&item.node);
    const auto& rule = std::get_if<RuleItem>(&item.node);
    names += family ? family->name.text : rule ? rule->name.text : "?";
  }
  return names;
}

using Lines = std::vector<std::string>;

}  // namespace

TEST_CASE("parsing goes on after a statement, so that each mistake is reported once") {
  const ParsedFile parsed{
      "rule r(a) {\n"
      "  left { a -0 b; c -1- ; d<0; }\n"  // 2: three
      "  let x = (1 + ;\n"                 // 3
      "  let = 2;\n"                       // 4
      "  forx y { a.b = 1; }\n"            // 5
      "  let y = 3\n"                      // 6
      "  where a.x > ;\n"                  // 7
      "  right { a; }\n"
      "}\n"
      "family f = g;\n"};
  CAPTURE(parsed.messages());
  CHECK(error_lines(parsed) == Lines{"2", "2", "2", "3", "4", "5", "6", "7"});
  CHECK(item_names(parsed) == "f");
}

TEST_CASE("an item with a mistake is left out, those around it are kept") {
  const ParsedFile parsed{
      "family a = x;\n"
      "family b = ;\n"
      "family c = x;\n"
      "rule d(a { left { a; } right { a; } }\n"
      "rule e(a) { left { a; } right { a; } }\n"
      "embedding f real on vertex;\n"
      "rule g(a) { where x $ y; }\n"
      "rule h(a) { where 1e999 > 0; }\n"
      "rule i(a) { left { a; } }\n"};
  CHECK(error_lines(parsed).size() == 5);
  CHECK(item_names(parsed) == "acei");
}

TEST_CASE("an item that begins in the first column ends whatever is still open") {
  const ParsedFile parsed{
      "operation a on face(x) {\n"
      "  for y in face(x) {\n"
      "    apply r(y);\n"
      "rule b(a) {\n"
      "  left { a; }\n"
      "}\n"};
  CHECK(error_lines(parsed) == Lines{"4"});
  CHECK(item_names(parsed) == "b");
}

TEST_CASE("a brace too many is reported and skipped") {
  const ParsedFile parsed{"rule a(x) { left { x; } } }\nrule b(x) { left { x; } }\n"};
  CHECK(error_lines(parsed) == Lines{"1"});
  CHECK(item_names(parsed) == "ab");
}

TEST_CASE("a statement of another item's kind does not confuse the next ones") {
  const ParsedFile parsed{
      "rule a(x) {\n"
      "  left {\n"
      "    let y = 3;\n"
      "    x<0>;\n"
      "  }\n"
      "}\n"
      "rule b(x) { left { x; } }\n"};
  CHECK(error_lines(parsed) == Lines{"3"});
  CHECK(item_names(parsed) == "b");
}

TEST_CASE("any prefix of a file is read or refused") {
  const std::string text =
      "/// Doc\nimport \"a\\\"b\"; embedding m : vec3[4] [N s/m] on <0..n-2,n> extensive split a "
      "merge mean = (1, 2e-3 [m], n);\noperation o on vertex(a) { for x in <2>(a) / corner where "
      "not free(x@(n-1), n) { apply r(x; k = 3); } if a.b { } else { a.c = sum(i in 0..8 : i); } }"
      "/* c */ rule r(a, b) { left { a<0,_> -0.n-1- b; } right { } }\n";
  for (std::size_t length = 0; length < text.size(); ++length) {
    CAPTURE(length);
    const ParsedFile parsed{text.substr(0, length)};
    for (const auto& diagnostic : parsed.diagnostics.all()) {
      REQUIRE(diagnostic.place);
      CHECK(diagnostic.place->begin <= diagnostic.place->end);
      CHECK(diagnostic.place->end <= length);
    }
    CHECK(parsed.diagnostics.all().size() <= 2);
  }
  CHECK(ParsedFile{text}.messages() == "");
}
