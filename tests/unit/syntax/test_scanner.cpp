// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "parsed.h"

using namespace gmsim;
using namespace gmsim::syntax;
using support::DiagnosticKind;

namespace {

std::string tokens(std::string text) {
  support::SourceMap sources;
  std::ostringstream out;
  dump_tokens(sources, sources.add("test", std::move(text)), out);
  return out.str();
}

/// The kind and place of the only message about a text.
struct Found {
  DiagnosticKind kind;
  std::uint32_t begin;
  std::uint32_t end;
  bool operator==(const Found&) const = default;
};
Found only_error(std::string text) {
  const ParsedFile parsed{std::move(text)};
  CAPTURE(parsed.messages());
  REQUIRE(parsed.diagnostics.all().size() == 1);
  const auto& diagnostic = parsed.diagnostics.all().front();
  REQUIRE(diagnostic.place);
  return {diagnostic.kind, diagnostic.place->begin, diagnostic.place->end};
}

}  // namespace

TEST_CASE("tokens are listed with their places") {
  CHECK(tokens("rule r\n{ a@0.x 0..n 1.5 }") ==
        "1:1 rule\n1:6 name r\n2:1 {\n2:3 name a\n2:4 @\n2:5 whole number 0\n2:6 .\n"
        "2:7 name x\n2:9 whole number 0\n2:10 ..\n2:12 n\n2:14 number 1.5\n2:18 }\n"
        "2:19 end of text\n");
}

TEST_CASE("a dot belongs to a number only between digits") {
  CHECK(tokens("1.5.x") == "1:1 number 1.5\n1:4 .\n1:5 name x\n1:6 end of text\n");
  CHECK(tokens("1...2") ==
        "1:1 whole number 1\n1:2 ..\n1:4 .\n1:5 whole number 2\n1:6 end of text\n");
  CHECK(tokens("1e5..2") == "1:1 number 1e5\n1:4 ..\n1:6 whole number 2\n1:7 end of text\n");
}

TEST_CASE("a byte-order mark and carriage returns are accepted") {
  const ParsedFile parsed{"\xef\xbb\xbf/// Doc.\r\nfamily a = b;\r\nfamily c = d;\r\n"};
  CHECK(parsed.messages() == "");
  REQUIRE(parsed.file.items.size() == 2);
  CHECK(parsed.file.items[0].doc == "Doc.\n");
  CHECK(parsed.sources.text(parsed.file.items[0].span) == "family a = b;");
}

TEST_CASE("a byte that is no text is reported where it stands") {
  CHECK(only_error(std::string("family a = b;\0", 14)) ==
        Found{DiagnosticKind::BadCharacter, 13, 14});
  CHECK(only_error("family a = b; // \xff") == Found{DiagnosticKind::BadCharacter, 17, 18});
  CHECK(only_error("/* \xc3( */") == Found{DiagnosticKind::BadCharacter, 3, 4});
  CHECK(only_error("/// \xed\xa0\x80\nfamily a = b;") == Found{DiagnosticKind::BadCharacter, 4, 5});
  CHECK(only_error("import \"\xf8\";") == Found{DiagnosticKind::BadCharacter, 8, 9});
  CHECK(only_error("\xe2\x82") == Found{DiagnosticKind::BadCharacter, 0, 1});
  CHECK(only_error("family a\x01 = b;") == Found{DiagnosticKind::BadCharacter, 8, 9});
}

TEST_CASE("text beyond ASCII belongs in comments and strings") {
  CHECK(ParsedFile{"// é ∂\n/* 力 */ import \"é.rule\";"}.messages() == "");
  CHECK(only_error("function f(a) = aé;") == Found{DiagnosticKind::BadCharacter, 17, 19});
  CHECK(only_error("function f(a) = a − 1;") == Found{DiagnosticKind::BadCharacter, 18, 21});
}

TEST_CASE("what is never closed is reported at its beginning") {
  CHECK(only_error("family a = b; /* x * y") == Found{DiagnosticKind::UnterminatedComment, 14, 16});
  CHECK(only_error("/**") == Found{DiagnosticKind::UnterminatedComment, 0, 2});
  CHECK(only_error("import \"a;\nfamily a = b;") ==
        Found{DiagnosticKind::UnterminatedComment, 7, 8});
}

TEST_CASE("numbers that cannot be read are reported") {
  CHECK(only_error("function f(a) = 12x;") == Found{DiagnosticKind::BadNumber, 16, 19});
  CHECK(only_error("function f(a) = 1e;") == Found{DiagnosticKind::BadNumber, 16, 18});
  CHECK(only_error("function f(a) = 1.5e+ 1;") == Found{DiagnosticKind::BadNumber, 16, 20});
  CHECK(only_error("function f(a) = 1e999 [m];") == Found{DiagnosticKind::BadNumber, 16, 21});
  CHECK(only_error("function f(a) = a@99999999999;") == Found{DiagnosticKind::BadNumber, 18, 29});
  CHECK(only_error("pattern p(a) { a -0.1e3- a; }") == Found{DiagnosticKind::BadNumber, 18, 23});
}

TEST_CASE("strings know two escapes") {
  const ParsedFile parsed{R"(import "a\"\\b";)"};
  REQUIRE(parsed.messages() == "");
  CHECK(std::get<ImportItem>(parsed.file.items.at(0).node).path == "a\"\\b");
  CHECK(only_error(R"(import "a\n";)") == Found{DiagnosticKind::Syntax, 7, 12});
}
