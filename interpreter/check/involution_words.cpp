// SPDX-License-Identifier: MIT
#include "check/involution_words.h"

#include <algorithm>
#include <cstdlib>

namespace gmsim::check {

InvolutionGroup::InvolutionGroup(std::size_t generators)
    : letter_(generators), commute_(generators, std::vector<bool>(generators, false)) {
  for (std::size_t g = 0; g < generators; ++g) letter_[g] = static_cast<std::uint8_t>(g);
}

InvolutionGroup InvolutionGroup::walks(int n) {
  InvolutionGroup group(static_cast<std::size_t>(n) + 1);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) group.commute_[i][j] = std::abs(i - j) >= 2;
  return group;
}

void InvolutionGroup::append(Word& word, std::uint8_t generator) const {
  const std::uint8_t x = letter_[generator];
  if (x == kTrivial) return;
  // The new letter may move left over letters that commute with it: it cancels against its equal,
  // or settles before the first greater letter it can reach.
  std::size_t place = word.size();
  for (std::size_t at = word.size(); at-- > 0;) {
    if (word[at] == x) {
      word.erase(word.begin() + static_cast<std::ptrdiff_t>(at));
      return;
    }
    if (!commute_[word[at]][x]) break;
    if (word[at] > x) place = at;
  }
  word.insert(word.begin() + static_cast<std::ptrdiff_t>(place), x);
}

Word InvolutionGroup::normal(const Word& word) const {
  Word result;
  for (const std::uint8_t generator : word) append(result, generator);
  return result;
}

Word InvolutionGroup::product(const Word& a, const Word& b) const {
  Word result = normal(a);
  for (const std::uint8_t generator : b) append(result, generator);
  return result;
}

Word InvolutionGroup::inverse(const Word& a) const {
  return normal(Word(a.rbegin(), a.rend()));
}

void InvolutionGroup::replace(std::uint8_t generator, std::uint8_t by) {
  for (std::uint8_t& letter : letter_)
    if (letter == generator) letter = by;
  if (by == kTrivial) return;
  for (std::size_t g = 0; g < commute_.size(); ++g) {
    const bool both = commute_[g][by] || commute_[g][generator];
    commute_[g][by] = both;
    commute_[by][g] = both;
  }
}

bool InvolutionGroup::learn_identity(const Word& word) {
  Word reduced = normal(word);
  // A conjugate of a relation is a relation: strip what the two ends share.
  while (reduced.size() > 2 && reduced.front() == reduced.back())
    reduced = Word(reduced.begin() + 1, reduced.end() - 1);
  if (reduced.size() == 1) {
    replace(reduced[0], kTrivial);
    return true;
  }
  if (reduced.size() == 2) {
    replace(std::max(reduced[0], reduced[1]), std::min(reduced[0], reduced[1]));
    return true;
  }
  if (reduced.size() == 4 && reduced[0] == reduced[2] && reduced[1] == reduced[3]) {
    commute_[reduced[0]][reduced[1]] = true;
    commute_[reduced[1]][reduced[0]] = true;
    return true;
  }
  return false;
}

}  // namespace gmsim::check
