// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "parsed.h"

using namespace gmsim;
using namespace gmsim::syntax;
using support::DiagnosticKind;

namespace {

std::string repeated(const std::string& piece, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += piece;
  return text;
}

/// Parses and expects a single message, of the kind TooDeep.
void check_too_deep(const std::string& text) {
  const ParsedFile parsed{text};
  REQUIRE(parsed.diagnostics.all().size() == 1);
  CHECK(parsed.diagnostics.all().front().kind == DiagnosticKind::TooDeep);
  CHECK(parsed.file.items.empty());
}

std::string function(const std::string& value) {
  return "function f(a) = " + value + ";";
}

std::string operation(const std::string& body) {
  return "operation o on vertex(a) {" + body + "}";
}

}  // namespace

TEST_CASE("nesting is bounded in every construct that nests") {
  constexpr std::size_t kMany = 100000;
  check_too_deep(function(repeated("(", kMany) + "a" + repeated(")", kMany)));
  check_too_deep(function(repeated("f(", kMany) + "a" + repeated(")", kMany)));
  check_too_deep(function(repeated("(1,", kMany) + "a" + repeated(")", kMany)));
  check_too_deep(function(repeated("a[", kMany) + "a" + repeated("]", kMany)));
  check_too_deep(function(repeated("<0>(", kMany) + "a" + repeated(")", kMany)));
  check_too_deep(function(repeated("sum(x in a : ", kMany) + "a" + repeated(")", kMany)));
  check_too_deep(function(repeated("-", kMany) + "a"));
  check_too_deep(function(repeated("not ", kMany) + "a"));
  check_too_deep(function(repeated("a^", kMany) + "a"));
  check_too_deep(function(repeated("if a then b else ", kMany) + "a"));
  check_too_deep(function(repeated("if ", kMany) + "a" + repeated(" then b else c", kMany)));
  check_too_deep(operation(repeated("for x in a {", kMany) + repeated("}", kMany)));
  check_too_deep(operation(repeated("if a {", kMany) + repeated("}", kMany)));
  check_too_deep(operation(repeated("if a { } else ", kMany) + "{ }"));
}

TEST_CASE("chains that nest to the left are bounded too") {
  constexpr std::size_t kMany = 100000;
  for (const char* link : {" + a", " - a", " * a", " / a", " and a", " or a", "@0", ".x", "[i]"}) {
    CAPTURE(link);
    check_too_deep(function("a" + repeated(link, kMany)));
  }
}

TEST_CASE("what people write stays below the limits") {
  CHECK(ParsedFile{function("a" + repeated(" + a", 500))}.messages() == "");
  CHECK(ParsedFile{function(repeated("(", 250) + "a" + repeated(")", 250))}.messages() == "");
  CHECK(ParsedFile{operation(repeated("if a {", 200) + repeated("}", 200))}.messages() == "");
}

TEST_CASE("long lists are no nesting") {
  constexpr std::size_t kMany = 20000;
  CHECK(ParsedFile{"family f = a" + repeated(", a", kMany) + ";"}.messages() == "");
  CHECK(ParsedFile{function("f(a" + repeated(", -a", kMany) + ")")}.messages() == "");
  CHECK(ParsedFile{"pattern p(a) { a" + repeated(" -0- a", kMany) + "; }"}.messages() == "");
  CHECK(ParsedFile{operation(repeated("a.b = 1;", kMany))}.messages() == "");
  CHECK(ParsedFile{repeated("family f = a;", kMany)}.file.items.size() == kMany);
}

TEST_CASE("reading gives up after a hundred errors") {
  CHECK(ParsedFile{repeated("}\n", 5000)}.diagnostics.error_count() == 100);
  CHECK(ParsedFile{repeated("$ ", 5000)}.diagnostics.error_count() == 100);
  CHECK(ParsedFile{"rule r(a) {\n" + repeated("let = 1;\n", 5000)}.diagnostics.error_count() ==
        100);
}

TEST_CASE("messages stay short whatever the text") {
  const std::string many(100000, 'a');
  const std::string digits(100000, '9');
  for (const std::string& text :
       {many, "family f = a " + many, function(digits), function(digits + many),
        function("a@" + digits), "pattern p(a) { a -" + digits + "- a; }"}) {
    const ParsedFile parsed{text};
    REQUIRE(parsed.diagnostics.has_errors());
    CHECK(parsed.diagnostics.all().front().message.size() < 300);
  }
}
