// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <random>
#include <string>

#include "support/check.h"
#include "support/source_map.h"

using namespace gmsim::support;

namespace {

std::string random_text(std::mt19937& random) {
  const std::string alphabet = "ab\t\n\n\r";
  std::string text(random() % 40, ' ');
  for (char& c : text) c = alphabet[random() % alphabet.size()];
  return text;
}

}  // namespace

TEST_CASE("every offset is located where counting line ends from the start puts it") {
  const unsigned seed = 7;
  INFO("seed ", seed);
  std::mt19937 random(seed);
  for (int trial = 0; trial < 200; ++trial) {
    SourceMap sources;
    const std::string text = random_text(random);
    const FileId file = sources.add("a.rule", text);
    std::uint32_t line = 1;
    std::uint32_t column = 1;
    for (std::uint32_t offset = 0; offset <= text.size(); ++offset) {
      const LineColumn found = sources.locate(file, offset);
      REQUIRE(found.line == line);
      REQUIRE(found.column == column);
      REQUIRE(sources.line_start(file, line) + column - 1 == offset);
      const bool line_end = offset < text.size() && text[offset] == '\n';
      line += line_end ? 1 : 0;
      column = line_end ? 1 : column + 1;
    }
  }
}

TEST_CASE("lines come without their ends, whichever system wrote the file") {
  SourceMap sources;
  const FileId file = sources.add("a.rule", "one\r\ntwo\n\nfour");
  CHECK(sources.line(file, 1) == "one");
  CHECK(sources.line(file, 2) == "two");
  CHECK(sources.line(file, 3).empty());
  CHECK(sources.line(file, 4) == "four");
  CHECK_THROWS_AS((void)sources.line(file, 5), InternalError);
}

TEST_CASE("spans and offsets past the end are cut to the text") {
  SourceMap sources;
  const FileId file = sources.add("a.rule", "abc\n");
  CHECK(sources.text(Span{file, 1, 99}) == "bc\n");
  CHECK(sources.text(Span{file, 50, 99}).empty());
  CHECK(sources.text(Span{file, 3, 1}).empty());
  CHECK(sources.locate(file, 99).line == 2);
  CHECK(sources.locate(file, 99).column == 1);
}

TEST_CASE("texts stay where they are when more files are added") {
  SourceMap sources;
  const FileId first = sources.add("first", "short");
  const std::string_view before = sources.text(first);
  for (int i = 0; i < 100; ++i) sources.add("more", std::string(100, 'x'));
  CHECK(sources.text(first).data() == before.data());
  CHECK(sources.name(first) == "first");
  CHECK_THROWS_AS((void)sources.name(FileId{101}), InternalError);
}
