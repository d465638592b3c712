// SPDX-License-Identifier: MIT
#include "support/suggest.h"

#include <algorithm>
#include <set>
#include <utility>

namespace gmsim::support {
namespace {

constexpr std::size_t kMaxSuggestions = 3;
/// Longer names are not typed by hand; comparing them would only cost time.
constexpr std::size_t kLongestName = 64;

/// Insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`
/// (optimal string alignment; a swap counts once because it is one slip of the hand).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) above[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, substitution});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(above);
    above.swap(row);
  }
  return above[b.size()];
}

}  // namespace

std::vector<std::string> close_names(std::string_view name,
                                     const std::vector<std::string>& candidates) {
  if (name.size() > kLongestName) return {};
  const std::size_t limit = name.size() / 3;
  std::set<std::pair<std::size_t, std::string>> near;
  for (const std::string& candidate : candidates) {
    if (candidate.size() + limit < name.size() || name.size() + limit < candidate.size()) continue;
    const std::size_t distance = edit_distance(name, candidate);
    if (distance > 0 && distance <= limit) near.emplace(distance, candidate);
  }
  std::vector<std::string> found;
  for (const auto& [distance, candidate] : near)
    if (found.size() < kMaxSuggestions) found.push_back(candidate);
  return found;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates) {
  const std::vector<std::string> near = close_names(name, candidates);
  if (near.empty()) return {};
  std::string text = "did you mean ";
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (i > 0) text += i + 1 == near.size() ? " or " : ", ";
    text += "`" + near[i] + "`";
  }
  return text + "?";
}

}  // namespace gmsim::support
