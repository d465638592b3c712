// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gmsim::test {

/// An example in a page: what stands between two lines of three backticks.
struct FencedBlock {
  std::filesystem::path page;
  int line = 0;     ///< of the opening fence
  std::string tag;  ///< what follows the backticks: "gmsim error:broken-cycle"
  std::string text;
};

/// The fenced blocks of a Markdown page in order.
[[nodiscard]] std::vector<FencedBlock> fenced_blocks(const std::filesystem::path& page);

}  // namespace gmsim::test
