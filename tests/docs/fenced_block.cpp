// SPDX-License-Identifier: MIT
#include "docs/fenced_block.h"

#include <fstream>

namespace gmsim::test {

std::vector<FencedBlock> fenced_blocks(const std::filesystem::path& page) {
  std::ifstream in(page);
  std::vector<FencedBlock> blocks;
  bool inside = false;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.starts_with("```")) {
      if (!inside) blocks.push_back({page, number, line.substr(3), ""});
      inside = !inside;
    } else if (inside) {
      blocks.back().text += line + "\n";
    }
  }
  return blocks;
}

}  // namespace gmsim::test
