// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "support/diagnostic.h"

using namespace gmsim::support;

namespace {

/// The span of the `nth` occurrence (from 1) of `needle`.
Span span_of(const SourceMap& sources, FileId file, std::string_view needle, int nth = 1) {
  std::size_t at = std::string_view::npos;
  for (int i = 0; i < nth; ++i) at = sources.text(file).find(needle, i == 0 ? 0 : at + 1);
  REQUIRE(at != std::string_view::npos);
  return {file, static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(at + needle.size())};
}

std::string rendered(const SourceMap& sources, Diagnostic diagnostic) {
  Diagnostics diagnostics;
  diagnostics.report(std::move(diagnostic));
  std::ostringstream out;
  render(diagnostics, sources, out);
  return out.str();
}

std::string rendered_at(const SourceMap& sources, Span place, std::vector<Label> related = {}) {
  return rendered(sources, {.kind = DiagnosticKind::Syntax,
                            .message = "m",
                            .place = place,
                            .related = std::move(related)});
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

}  // namespace

TEST_CASE("a place, what explains it in another line, and help") {
  SourceMap sources;
  const FileId file = sources.add("my.rule",
                                  "rule r(a) {\n"
                                  "\n"
                                  "    left  { a<0> -2- b<0>; }\n"
                                  "    right { a -2- a; b; }\n"
                                  "}\n");
  Span link = span_of(sources, file, "-2-");
  Span node = span_of(sources, file, "b;");
  node.end -= 1;
  CHECK(rendered(sources, {.kind = DiagnosticKind::IncidentArcs,
                           .message = "node `b` has a 2-link in `left` and none in `right`",
                           .place = node,
                           .related = {{link, "2-link of `b`"}},
                           .notes = {"in dimension 2"},
                           .help = "write `b -2- b` to leave `b` 2-free"}) ==
        "error: node `b` has a 2-link in `left` and none in `right` [incident-arcs]\n"
        " --> my.rule:4:22\n"
        "  |\n"
        "3 |     left  { a<0> -2- b<0>; }\n"
        "  |                  --- 2-link of `b`\n"
        "4 |     right { a -2- a; b; }\n"
        "  |                      ^\n"
        "note: in dimension 2\n"
        "help: write `b -2- b` to leave `b` 2-free\n");
}

TEST_CASE("the gutter is as wide as the largest line number; far lines are cut out") {
  SourceMap sources;
  const FileId file = sources.add("my.rule", "one\n2\n3\n4\n5\n6\n7\neight\n9\nten\n");
  CHECK(rendered_at(
            sources, span_of(sources, file, "ten"),
            {{span_of(sources, file, "one"), "here"}, {span_of(sources, file, "eight"), ""}}) ==
        "error: m [syntax]\n"
        "  --> my.rule:10:1\n"
        "   |\n"
        " 1 | one\n"
        "   | --- here\n"
        "...\n"
        " 8 | eight\n"
        "   | -----\n"
        " 9 | 9\n"
        "10 | ten\n"
        "   | ^^^\n");
}

TEST_CASE("related places of other files follow in a block of their own") {
  SourceMap sources;
  const FileId library = sources.add("lib.rule", "orbit corner = <1>;\n");
  const FileId file = sources.add("my.rule", "orbit corner = <2>;\n");
  CHECK(rendered_at(sources, span_of(sources, file, "<2>"),
                    {{span_of(sources, library, "corner"), "declared here"}}) ==
        "error: m [syntax]\n"
        " --> my.rule:1:16\n"
        "  |\n"
        "1 | orbit corner = <2>;\n"
        "  |                ^^^\n"
        " ::: lib.rule:1:7\n"
        "  |\n"
        "1 | orbit corner = <1>;\n"
        "  |       ------ declared here\n");
}

TEST_CASE("carets and dashes of one line share a row when they do not touch") {
  SourceMap sources;
  const FileId file = sources.add("my.rule", "abc def ghi\n");
  const Span abc = span_of(sources, file, "abc");
  const Span def = span_of(sources, file, "def");
  const Span ghi = span_of(sources, file, "ghi");
  const std::string head = "error: m [syntax]\n --> my.rule:1:5\n  |\n1 | abc def ghi\n";
  CHECK(rendered_at(sources, def, {{ghi, "later"}}) == head + "  |     ^^^ --- later\n");
  CHECK(rendered_at(sources, def, {{abc, ""}}) == head + "  | --- ^^^\n");
  CHECK(rendered_at(sources, def, {{abc, "before"}}) == head + "  |     ^^^\n  | --- before\n");
  CHECK(rendered_at(sources, def, {{abc, "before"}, {ghi, "later"}}) ==
        head + "  |     ^^^ --- later\n  | --- before\n");
}

TEST_CASE("dashes never hide carets") {
  SourceMap sources;
  const FileId file = sources.add("my.rule", "abc def ghi\n");
  CHECK(rendered_at(sources, span_of(sources, file, "def"), {{Span{file, 0, 11}, "all"}}) ==
        "error: m [syntax]\n --> my.rule:1:5\n  |\n1 | abc def ghi\n"
        "  |     ^^^\n"
        "  | ----------- all\n");
}

TEST_CASE("a span over several lines is cut at the end of the first, blanks left out") {
  SourceMap sources;
  const FileId file = sources.add("my.rule", "rule r {  \r\n  left;\r\n}\r\n");
  const std::string text = rendered_at(sources, Span{file, 5, 20});
  CHECK(lines_of(text)[3] == "1 | rule r {  ");
  CHECK(lines_of(text)[4] == "  |      ^^^");
}

TEST_CASE("places at and past the end of the file are shown at its end") {
  SourceMap sources;
  const FileId file = sources.add("my.rule", "ab\nc");
  const FileId empty = sources.add("empty.rule", "");
  const FileId ended = sources.add("ended.rule", "ab\n");
  const std::string at_end = "error: m [syntax]\n --> my.rule:2:2\n  |\n2 | c\n  |  ^\n";
  CHECK(rendered_at(sources, Span{file, 4, 4}) == at_end);
  CHECK(rendered_at(sources, Span{file, 1000, 2000}) == at_end);
  CHECK(rendered_at(sources, Span{empty, 0, 0}) ==
        "error: m [syntax]\n --> empty.rule:1:1\n  |\n1 |\n  | ^\n");
  CHECK(rendered_at(sources, Span{ended, 3, 3}) ==
        "error: m [syntax]\n --> ended.rule:2:1\n  |\n2 |\n  | ^\n");
  CHECK(rendered_at(sources, Span{ended, 2, 3}) ==
        "error: m [syntax]\n --> ended.rule:1:3\n  |\n1 | ab\n  |   ^\n");
}

TEST_CASE("columns are counted in bytes, carets stand under characters") {
  SourceMap sources;
  const FileId file = sources.add("my.rule", "// α₀\té; x\n");
  CHECK(rendered_at(sources, span_of(sources, file, "x")) ==
        "error: m [syntax]\n --> my.rule:1:14\n  |\n"
        "1 | // α₀   é; x\n"
        "  |            ^\n");
}

TEST_CASE("bytes that are no text show as replacement characters") {
  SourceMap sources;
  const FileId file = sources.add("my.rule", std::string("a\xff\x01\xe2\x82 b\n", 8));
  CHECK(rendered_at(sources, span_of(sources, file, "b")) ==
        "error: m [syntax]\n --> my.rule:1:7\n  |\n"
        "1 | a\ufffd\ufffd\ufffd\ufffd b\n"
        "  |       ^\n");
}

TEST_CASE("of a very long line only the surroundings are shown") {
  SourceMap sources;
  const FileId file = sources.add("my.rule", std::string(5000, 'a') + "X" + std::string(5000, 'b'));
  const std::vector<std::string> lines = lines_of(rendered_at(sources, Span{file, 5000, 9000}));
  REQUIRE(lines.size() == 5);
  CHECK(lines[1] == " --> my.rule:1:5001");
  CHECK(lines[3] == "1 | …" + std::string(60, 'a') + "X" + std::string(99, 'b') + "…");
  CHECK(lines[4] == "  | " + std::string(61, ' ') + std::string(100, '^'));
}

TEST_CASE("a message without a place is its text alone") {
  CHECK(
      rendered(SourceMap{},
               {.kind = DiagnosticKind::Usage, .message = "no scene given", .help = "gmsim -h"}) ==
      "error: no scene given [usage]\nhelp: gmsim -h\n");
  CHECK(rendered(SourceMap{}, {.kind = DiagnosticKind::Shadowing,
                               .message = "hides",
                               .severity = Severity::Warning}) == "warning: hides [shadowing]\n");
}

TEST_CASE("messages come in order of file and position, those without a place last") {
  SourceMap sources;
  const FileId first = sources.add("first.rule", "abcdef");
  const FileId second = sources.add("second.rule", "abcdef");
  Diagnostics diagnostics;
  const auto report = [&](std::string message, std::optional<Span> place) {
    diagnostics.report(
        {.kind = DiagnosticKind::Syntax, .message = std::move(message), .place = place});
  };
  report("5", std::nullopt);
  report("4", Span{second, 0, 1});
  report("3", Span{first, 4, 5});
  report("1", Span{first, 1, 2});
  report("2", Span{first, 1, 3});
  std::ostringstream out;
  render(diagnostics, sources, out);
  std::string order;
  for (const std::string& line : lines_of(out.str()))
    if (line.starts_with("error: ")) order += line[7];
  CHECK(order == "12345");
}

TEST_CASE("after the limit the rest is counted, errors and warnings apart") {
  Diagnostics diagnostics;
  for (int i = 0; i < 23; ++i)
    diagnostics.report({.kind = DiagnosticKind::Usage, .message = std::to_string(i)});
  for (int i = 0; i < 21; ++i)
    diagnostics.report({.kind = DiagnosticKind::Shadowing,
                        .message = std::to_string(i),
                        .severity = Severity::Warning});
  std::ostringstream out;
  render(diagnostics, SourceMap{}, out);
  const std::string text = out.str();
  CHECK(text.find("error: 19 ") != std::string::npos);
  CHECK(text.find("error: 20 ") == std::string::npos);
  CHECK(text.find("warning: 19 ") != std::string::npos);
  CHECK(text.ends_with("\n… and 3 more errors\n\n… and 1 more warning\n"));
}

TEST_CASE("any text with any spans prints, and labels leave the carets as they were") {
  const unsigned seed = 20171;
  INFO("seed ", seed);
  std::mt19937 random(seed);
  const std::vector<std::string> pieces = {"a", "b", " ",    "\t", "\n",  "\r\n",
                                           "é", "₀", "\xff", "𝛼",  "\x80"};
  for (int trial = 0; trial < 2000; ++trial) {
    std::string text;
    for (auto i = random() % 60; i > 0; --i) text += pieces[random() % pieces.size()];
    SourceMap sources;
    const FileId file = sources.add("f", text);
    const auto span = [&] {
      const auto begin = static_cast<std::uint32_t>(random() % (text.size() + 3));
      return Span{file, begin, begin + static_cast<std::uint32_t>(random() % 9)};
    };
    const auto caret_rows = [](const std::string& shown) {
      std::vector<std::string> rows;
      for (std::string line : lines_of(shown)) {
        if (line.find('^') == std::string::npos) continue;
        line = line.substr(line.find('|'), line.rfind('^') + 1 - line.find('|'));
        std::replace(line.begin(), line.end(), '-', ' ');
        rows.push_back(line);
      }
      return rows;
    };
    const Span place = span();
    const std::vector<std::string> bare = caret_rows(rendered_at(sources, place));
    REQUIRE(bare.size() == 1);
    std::vector<Label> related;
    for (auto i = random() % 4; i > 0; --i)
      related.push_back({span(), random() % 2 == 0 ? "" : "why"});
    REQUIRE(caret_rows(rendered_at(sources, place, related)) == bare);
  }
}
