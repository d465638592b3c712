// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "parsed.h"

using namespace gmsim;
using namespace gmsim::syntax;
using support::DiagnosticKind;

namespace {

/// A text with the place of its only error between `«` and `»`, and what is said there.
struct Mistake {
  std::string marked;
  DiagnosticKind kind;
  std::string message;
  std::string help = {};
};

std::string without_marks(std::string text, std::uint32_t& begin, std::uint32_t& end) {
  const std::string open = "«";
  const std::string close = "»";
  const std::size_t first = text.find(open);
  REQUIRE(first != std::string::npos);
  text.erase(first, open.size());
  const std::size_t last = text.find(close);
  REQUIRE(last != std::string::npos);
  text.erase(last, close.size());
  begin = static_cast<std::uint32_t>(first);
  end = static_cast<std::uint32_t>(last);
  return text;
}

void check(const Mistake& mistake) {
  CAPTURE(mistake.marked);
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  const ParsedFile parsed{without_marks(mistake.marked, begin, end)};
  CAPTURE(parsed.messages());
  REQUIRE(parsed.diagnostics.all().size() == 1);
  const support::Diagnostic& found = parsed.diagnostics.all().front();
  CHECK(found.kind == mistake.kind);
  CHECK(found.message == mistake.message);
  CHECK(found.help == mistake.help);
  REQUIRE(found.place);
  CHECK(found.place->begin == begin);
  CHECK(found.place->end == end);
}

constexpr DiagnosticKind kSyntax = DiagnosticKind::Syntax;

}  // namespace

TEST_CASE("a misspelt word is reported with the words that may stand there") {
  check({"rule r(a) {\n  «rihgt» { a -2- a; }\n}", kSyntax,
         "unexpected name `rihgt`; expected `left`, `right`, `where`, `param`, `let`, "
         "`dimension`, an assignment or `}`",
         "did you mean `right`?"});
  check({"interaction i on face(a) {\n  «enrgy» 3;\n}", kSyntax,
         "unexpected name `enrgy`; expected `match`, `param`, `let`, `energy`, `force`, `first`, "
         "`result`, `dimension` or `}`",
         "did you mean `energy`?"});
  check({"criterion c on face(a) { «valeu» 3; }", kSyntax,
         "unexpected name `valeu`; expected `match`, `param`, `let`, `where`, `value`, `result`, "
         "`apply`, `dimension` or `}`",
         "did you mean `value`?"});
  check({"operation o on face(a) { «aply» r(a); }", kSyntax,
         "unexpected name `aply`; expected `let`, `param`, `for`, `if`, `apply`, `dimension`, "
         "an assignment or `}`",
         "did you mean `apply`?"});
  check({"«rul» r(a) { left { a; } }", kSyntax,
         "unexpected name `rul`; expected `rule`, `interaction`, `function`, `import` or another "
         "item",
         "did you mean `rule`?"});
  check({"function f(a) = a «andd» b;", kSyntax,
         "unexpected name `andd`; expected an operator or `;`", "did you mean `and`?"});
  check({"rule r(a) { «x» = 3; }", kSyntax,
         "unexpected name `x`; expected `left`, `right`, `where`, `param`, `let`, `dimension`, an "
         "assignment or `}`",
         "a value gets a name by `let x = …;`"});
}

TEST_CASE("a missing semicolon is reported at the end of what it should end") {
  check({"rule r(a) {\n  let x = 3«»\n  let y = 4;\n}", kSyntax, "expected `;`"});
  check({"rule r(a) { left { a -0- b«» } }", kSyntax, "expected `;`"});
  check({"criterion c on face(a) { value 3«» }", kSyntax, "expected `;`"});
  check({"family f = a, b«»\nrule r(a) { }", kSyntax, "expected `;`"});
  check({"family f = a, b«»", kSyntax, "expected `;`"});
  check({"embedding e : real [m] on vertex«»  // comment\n\n", kSyntax, "expected `;`"});
}

TEST_CASE("long lists of what may stand somewhere are grouped") {
  check({"function f(a) = «;»", kSyntax, "unexpected `;`; expected an expression"});
  check({"function f(a) = a + «*» b;", kSyntax, "unexpected `*`; expected an expression"});
  check({"function f(a) = g(a«;»", kSyntax, "unexpected `;`; expected an operator, `)` or `,`"});
  check({"function f(a) = 4 «5»;", kSyntax, "unexpected number `5`; expected an operator or `;`"});
  check({"function f(a) = a.«;»", kSyntax, "unexpected `;`; expected a name"});
  check({"function «=» 3;", kSyntax, "unexpected `=`; expected a name"});
  check({"embedding e : real on «3»;", kSyntax, "unexpected number `3`; expected an orbit"});
  check({"family f = «\"a\"»;", kSyntax, "unexpected string; expected a name"});
  check({"function f(a) = a@«0.5»;", kSyntax,
         "unexpected number `0.5`; expected a whole number, `n` or `(`"});
  check(
      {"rule r(a) { left { a «{» } } }", kSyntax, "unexpected `{`; expected `(`, `;`, `-` or `<`"});
  check({"function f(a) = sum(x in «:» 3);", kSyntax, "unexpected `:`; expected an expression"});
  check({"function f(a) = sum(x in a «;»", kSyntax,
         "unexpected `;`; expected an operator, `)`, `:` or `..`"});
}

TEST_CASE("reserved words cannot be names") {
  check({"rule r(a) { let «where» = 3; }", kSyntax,
         "unexpected reserved word `where`; expected a name"});
  check({"family f = «in»;", kSyntax, "unexpected reserved word `in`; expected a name"});
}

TEST_CASE("frequent slips are explained") {
  check({"function f(a) = «.»5;", kSyntax, "unexpected `.`; expected an expression",
         "a number has digits on both sides of its point, as in `0.5`"});
  check({"function f(a) = 1«.»;", kSyntax, "unexpected `.`; expected an operator or `;`",
         "a number has digits on both sides of its point, as in `0.5`"});
  check({"function f(a) = a < b «<» c;", kSyntax, "unexpected `<`; expected an operator or `;`",
         "comparisons do not chain: write `a < b and b < c`"});
  check({"orbit o = <1>;\nembedding e : real on <1«>=» 3;", kSyntax,
         "unexpected `>=`; expected `,`, `..` or `>`", "put a blank between `>` and `=`"});
  check({"rule r(a) { where a «=» b; }", kSyntax, "unexpected `=`; expected an operator or `;`",
         "equality is `==`"});
  check({"function f(a) = a «&&» b;", DiagnosticKind::BadCharacter, "unexpected character `&&`",
         "the word is `and`"});
  check({"function f(a) = «!»b;", DiagnosticKind::BadCharacter, "unexpected character `!`",
         "the word is `not`"});
}

TEST_CASE("`if` stands only at the top of an expression") {
  check({"function f(a) = 1 + «if» a then b else c;", kSyntax,
         "unexpected reserved word `if`; expected an expression"});
}

TEST_CASE("a block left open is pointed at") {
  const ParsedFile parsed{"rule r(a) {\n  left { a; }\n\nrule s(a) { left { a; } }\n"};
  REQUIRE(parsed.diagnostics.all().size() == 1);
  const support::Diagnostic& found = parsed.diagnostics.all().front();
  CHECK(parsed.sources.text(*found.place) == "rule");
  REQUIRE(found.related.size() == 1);
  CHECK(found.related[0].span.begin == 10);
  CHECK(found.related[0].text == "this block is not closed");
  REQUIRE(parsed.file.items.size() == 1);
  CHECK(std::get<RuleItem>(parsed.file.items[0].node).name.text == "s");

  const ParsedFile at_end{"rule r(a) {\n  left { a; }\n"};
  REQUIRE(at_end.diagnostics.all().size() == 1);
  CHECK(at_end.diagnostics.all().front().message.starts_with("unexpected end of text"));
  REQUIRE(at_end.diagnostics.all().front().related.size() == 1);
  CHECK(at_end.diagnostics.all().front().related[0].span.begin == 10);
}

TEST_CASE("units, types and clauses are checked as far as the grammar cannot") {
  check({"embedding e : real [«N/m s»] on vertex;", DiagnosticKind::AmbiguousUnit,
         "this unit can be read in two ways",
         "put what is divided by in parentheses, as in `[N/(m s)]`"});
  check({"function f(a) = 3 [«N/m/s»];", DiagnosticKind::AmbiguousUnit,
         "this unit can be read in two ways",
         "put what is divided by in parentheses, as in `[N/(m s)]`"});
  check({"function f(a) = 3 [«N/(m s) kg»];", DiagnosticKind::AmbiguousUnit,
         "this unit can be read in two ways",
         "put what is divided by in parentheses, as in `[N/(m s)]`"});
  check(
      {"function f(a) = 3 [«2»/s];", kSyntax, "`2` is no unit; plain numbers have the unit `[1]`"});
  check({"function f(a) = 3 [«7»];", kSyntax, "`7` is no unit; plain numbers have the unit `[1]`"});
  check(
      {"function f(a) = 3 [m^(1/«0»)];", DiagnosticKind::BadNumber, "an exponent divided by zero"});
  check({"embedding e : real[«0»] on vertex;", DiagnosticKind::BadNumber,
         "the length of an array is at least 2", "`[1]`, the unit of plain numbers, stands last"});
  check({"embedding e : real[1][«2»] on vertex;", DiagnosticKind::BadNumber,
         "the length of an array is at least 2", "`[1]`, the unit of plain numbers, stands last"});
  check(
      {"embedding e : real on vertex merge mean «merge max»;", kSyntax, "`merge` is given twice"});
  check(
      {"embedding e : real on vertex optional «optional»;", kSyntax, "`optional` is given twice"});
  check({"interaction i on face(a) { param p : real intensive «extensive»; }", kSyntax,
         "`intensive` or `extensive` is given twice"});
  check({"dimension «4»;", DiagnosticKind::Dimension, "the dimension of a map is 1, 2 or 3"});
  check({"pattern p(a) { dimension «0»; }", DiagnosticKind::Dimension,
         "the dimension of a map is 1, 2 or 3"});
}

TEST_CASE("expressions and units are read to their end") {
  const ParsedExpression two{"a b"};
  CHECK_FALSE(two.expr);
  CHECK(two.diagnostics.all().at(0).message ==
        "unexpected name `b`; expected an operator or the end");
  const ParsedExpression none{""};
  CHECK_FALSE(none.expr);
  CHECK(none.diagnostics.all().at(0).message == "unexpected end of text; expected an expression");
  CHECK_FALSE(ParsedExpression{"(a"}.expr);

  support::SourceMap sources;
  support::Diagnostics diagnostics;
  CHECK_FALSE(parse_unit(sources, sources.add("unit", "N/m s"), diagnostics));
  CHECK_FALSE(parse_unit(sources, sources.add("unit", "[N]"), diagnostics));
  CHECK_FALSE(parse_unit(sources, sources.add("unit", "2"), diagnostics));
  CHECK_FALSE(parse_unit(sources, sources.add("unit", ""), diagnostics));
  CHECK(diagnostics.error_count() == 4);
}
