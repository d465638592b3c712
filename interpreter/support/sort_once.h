// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

namespace gmsim::support {

/// Sorts in ascending order and keeps one of each.
template <typename Entry>
void sort_once(std::vector<Entry>& entries) {
  std::sort(entries.begin(), entries.end());
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
}

}  // namespace gmsim::support
