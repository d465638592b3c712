// SPDX-License-Identifier: MIT
#include "stdlib/test_block.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace gmsim::test {
namespace {

constexpr std::string_view kDoc = "///";

std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

bool is_indented_doc(const std::string& line) {
  return line == kDoc || line.starts_with("///   ");
}

}  // namespace

std::string TestBlock::title() const {
  return fmt::format("{}:{}: {}", file.string(), line,
                     yaml["about"] ? yaml["about"].as<std::string>() : "a test block");
}

std::vector<TestBlock> blocks_of_file(const std::filesystem::path& file) {
  const std::vector<std::string> lines = lines_of(file);
  std::vector<TestBlock> blocks;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!lines[i].starts_with("/// Test:")) continue;
    std::string text;
    const std::size_t first = i + 1;
    for (++i; i < lines.size() && is_indented_doc(lines[i]); ++i)
      text += lines[i].substr(kDoc.size()) + "\n";
    for (const YAML::Node& entry : YAML::Load(text))
      blocks.push_back({file, static_cast<int>(first) + entry.Mark().line + 1, entry});
  }
  return blocks;
}

std::vector<TestBlock> blocks_of_folder(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".rule") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<TestBlock> blocks;
  for (const auto& file : files) std::ranges::move(blocks_of_file(file), std::back_inserter(blocks));
  return blocks;
}

}  // namespace gmsim::test
