// SPDX-License-Identifier: MIT
// Runs every fenced example of README.md and docs/*.md:
//   ```gmsim                       a complete file without errors
//   ```gmsim fragment:expression   one expression a line, as scenes hold them
//   ```gmsim error:KIND            a file whose errors are all of this kind
//   ```yaml scene                  YAML
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "docs/check_text.h"
#include "docs/fenced_block.h"

namespace gmsim::test {
namespace {

std::string place(const FencedBlock& block) {
  return fmt::format("{}:{}", block.page.string(), block.line);
}

std::vector<FencedBlock> examples() {
  std::vector<std::filesystem::path> pages = {"README.md"};
  for (const auto& entry : std::filesystem::directory_iterator("docs"))
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  std::sort(pages.begin() + 1, pages.end());
  std::vector<FencedBlock> blocks;
  for (const auto& page : pages)
    for (FencedBlock& block : fenced_blocks(page)) blocks.push_back(std::move(block));
  return blocks;
}

void check_expressions(const FencedBlock& block) {
  std::istringstream lines(block.text);
  int number = block.line;
  for (std::string line; std::getline(lines, line);) {
    const std::string name = fmt::format("{}:{}", block.page.string(), ++number);
    if (line.empty()) continue;
    const CheckOutcome outcome = check_scene_expression({name, line}, 2);
    CHECK_MESSAGE(outcome.error_kinds.empty(), name, "\n", outcome.rendered);
  }
}

void check_example(const FencedBlock& block) {
  static const std::string error = "gmsim error:";
  if (block.tag == "gmsim") {
    const CheckOutcome outcome = check_rule_texts({{place(block), block.text}});
    CHECK_MESSAGE(outcome.error_kinds.empty(), place(block), "\n", outcome.rendered);
  } else if (block.tag == "gmsim fragment:expression") {
    check_expressions(block);
  } else if (block.tag.starts_with(error)) {
    const CheckOutcome outcome = check_rule_texts({{place(block), block.text}});
    const std::set<std::string> wanted = {block.tag.substr(error.size())};
    CHECK_MESSAGE(outcome.error_kinds == wanted, place(block), " should be refused as ",
                  *wanted.begin(), "\n", outcome.rendered);
  } else if (block.tag == "yaml scene") {
    CHECK_NOTHROW_MESSAGE(static_cast<void>(YAML::Load(block.text)), place(block));
  } else {
    CHECK_MESSAGE(!block.tag.starts_with("gmsim"), place(block), ": unknown tag `", block.tag, "`");
  }
}

TEST_CASE("the examples of the pages are what they say") {
  const auto blocks = examples();
  CHECK(blocks.size() > 20);
  for (const FencedBlock& block : blocks) check_example(block);
}

}  // namespace
}  // namespace gmsim::test
