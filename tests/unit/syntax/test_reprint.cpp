// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "parsed.h"
#include "samples.h"

using namespace gmsim::syntax;

namespace {

void check_round_trip(const std::string& text) {
  const ParsedFile first{text};
  REQUIRE(first.messages() == "");
  const std::string reprinted = reprint(first.file);
  CAPTURE(reprinted);
  const ParsedFile second{reprinted};
  CHECK(second.messages() == "");
  CHECK(same_tree(first.file, second.file));
  CHECK(reprint(second.file) == reprinted);
}

}  // namespace

TEST_CASE("a reprinted item parses to the same tree") {
  for (const Sample& sample : kItems) {
    CAPTURE(sample.source);
    check_round_trip(std::string(sample.source));
  }
}

TEST_CASE("a reprinted expression parses to the same tree") {
  for (const Sample& sample : kExpressions) {
    CAPTURE(sample.source);
    const ParsedExpression first{std::string(sample.source)};
    REQUIRE(first.expr);
    const ParsedExpression second{reprint(*first.expr)};
    CHECK(second.messages() == "");
    CHECK(second.tree() == first.tree());
  }
}

TEST_CASE("a reprinted file of the library parses to the same tree") {
  const std::filesystem::path folder = "stdlib-rules";
  if (!std::filesystem::exists(folder)) return;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".rule") continue;
    CAPTURE(entry.path());
    std::ifstream in(entry.path(), std::ios::binary);
    check_round_trip(std::string(std::istreambuf_iterator<char>(in), {}));
  }
}

TEST_CASE("trees differ when anything but places does") {
  const char* base = "rule r(a) { left { a<0>; } where a.x > (1); }";
  CHECK(same_tree(ParsedFile{base}.file,
                  ParsedFile{"rule r( a ){left{a<0>;}\n// c\nwhere a.x>(1);}"}.file));
  for (const char* other : {
           "rule s(a) { left { a<0>; } where a.x > (1); }",
           "rule r(b) { left { a<0>; } where a.x > (1); }",
           "rule r(a) { right { a<0>; } where a.x > (1); }",
           "rule r(a) { left { a<1>; } where a.x > (1); }",
           "rule r(a) { left { a; } where a.x > (1); }",
           "rule r(a) { left { a<0>; } where a.y > (1); }",
           "rule r(a) { left { a<0>; } where a.x >= (1); }",
           "rule r(a) { left { a<0>; } where a.x > 1; }",
           "rule r(a) { left { a<0>; } where a.x > (1.0); }",
           "/// Doc.\nrule r(a) { left { a<0>; } where a.x > (1); }",
           "rule r(a) { left { a<0>; } }",
       }) {
    CAPTURE(other);
    CHECK_FALSE(same_tree(ParsedFile{base}.file, ParsedFile{other}.file));
  }
}
