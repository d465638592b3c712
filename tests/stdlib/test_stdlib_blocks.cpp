// SPDX-License-Identifier: MIT
// Runs the test blocks of the standard library, with both matchers.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "stdlib/block_run.h"

namespace gmsim::test {
namespace {

const std::vector<TestBlock>& library_blocks() {
  static const std::vector<TestBlock> blocks = blocks_of_folder("stdlib-rules");
  return blocks;
}

void run_all(engine::MatcherKind matcher) {
  for (const TestBlock& block : library_blocks()) {
    const auto failures = run_block(block, matcher);
    CHECK_MESSAGE(failures.empty(), block.title(), "\n  ", fmt::format("{}", fmt::join(failures, "\n  ")));
  }
}

TEST_CASE("the test blocks of the library hold") { run_all(engine::MatcherKind::Planned); }
TEST_CASE("the test blocks hold with the naive matcher") { run_all(engine::MatcherKind::Naive); }

TEST_CASE("every file of the library has a place in its README") {
  std::ifstream in("stdlib-rules/README.md");
  const std::string readme{std::istreambuf_iterator<char>(in), {}};
  for (const auto& entry : std::filesystem::recursive_directory_iterator("stdlib-rules")) {
    if (entry.path().extension() != ".rule") continue;
    const auto name = std::filesystem::relative(entry.path(), "stdlib-rules").string();
    CHECK_MESSAGE(readme.find("`" + name + "`") != std::string::npos, name);
  }
}

TEST_CASE("the runner notices what does not hold") {
  const auto broken = [](const std::string& text) {
    return !run_block({"none.rule", 1, YAML::Load(text)}, engine::MatcherKind::Planned).empty();
  };
  CHECK_FALSE(broken("{ mesh: 'grid:quads:2x1', expect: { faces: 2 } }"));
  CHECK(broken("{ mesh: 'grid:quads:2x1', expect: { faces: 3 } }"));
  CHECK(broken("{ mesh: 'grid:quads:2x1', expect: { 'count(f in all face)': 3 } }"));
  CHECK(broken("{ mesh: 'grid:quads:2x1', apply: separate_elements, not_applied: true }"));
  CHECK(broken("{ mesh: 'grid:quads:2x1', apply: no_such_rule }"));
  CHECK(broken("{ mesh: 'grid:quads:2x1', expcet: { faces: 2 } }"));
  CHECK(broken("{ mesh: 'grid:quads:1x1', interaction: stretch_spring, params: { stiffness: 1 }, "
               "expect: { matches: 3 } }"));
  CHECK(broken("{ mesh: 'grid:quads:1x1', interaction: stretch_spring, params: { stiffness: 1, "
               "rest: 0.5 }, expect: { force: { 0: [0.5, 0.6, 0] } } }"));
}

}  // namespace
}  // namespace gmsim::test
