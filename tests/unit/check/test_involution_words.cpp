// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "check/involution_words.h"
#include "support/tiny_map.h"

using namespace gmsim;
using check::InvolutionGroup;
using check::Word;
using tests::Random;

namespace {

Word random_word(Random& random, int letters, int length) {
  Word word;
  for (int k = 0; k < length; ++k)
    word.push_back(static_cast<std::uint8_t>(tests::below(random, letters)));
  return word;
}

/// Rewrites a word at random by the laws: inserts and removes squares, exchanges what commutes.
Word disguised(Word word, const InvolutionGroup& group, Random& random) {
  for (int k = 0; k < 30; ++k) {
    const std::size_t at =
        static_cast<std::size_t>(tests::below(random, static_cast<int>(word.size()) + 1));
    const auto begin = word.begin() + static_cast<std::ptrdiff_t>(at);
    if (tests::chance(random, 0.3)) {
      const auto letter =
          static_cast<std::uint8_t>(tests::below(random, static_cast<int>(group.size())));
      word.insert(begin, {letter, letter});
    } else if (at + 1 < word.size()) {
      if (word[at] == word[at + 1]) {
        word.erase(begin, begin + 2);
      } else if (group.commute(word[at], word[at + 1])) {
        std::swap(word[at], word[at + 1]);
      }
    }
  }
  return word;
}

}  // namespace

TEST_CASE("words that the laws make equal have one form") {
  Random random(17);
  const InvolutionGroup group = InvolutionGroup::walks(3);
  for (int k = 0; k < 2000; ++k) {
    const Word word = random_word(random, 4, tests::below(random, 10));
    CHECK(group.normal(word) == group.normal(disguised(word, group, random)));
    CHECK(group.product(word, group.inverse(word)).empty());
  }
}

TEST_CASE("words of different form differ in some map") {
  Random random(18);
  const InvolutionGroup group = InvolutionGroup::walks(3);
  for (int k = 0; k < 200; ++k) {
    const Word a = group.normal(random_word(random, 4, 5)),
               b = group.normal(random_word(random, 4, 5));
    bool differ = false;
    for (int map_count = 0; map_count < 60 && !differ; ++map_count) {
      const tests::TinyMap map = tests::random_tiny_map(3, random);
      const auto walk = [&](const Word& word) {
        int dart = 0;
        for (const std::uint8_t i : word) dart = map.links[static_cast<std::size_t>(dart)][i];
        return dart;
      };
      differ = walk(a) != walk(b);
    }
    CHECK(differ == (a != b));
  }
}

TEST_CASE("relations are learnt") {
  InvolutionGroup group(3);
  CHECK(group.normal({0, 1, 0, 1}).size() == 4);
  CHECK(group.learn_identity({0, 1, 0, 1}));
  CHECK(group.normal({1, 0}) == Word{0, 1});
  CHECK(!group.learn_identity({0, 1, 0, 1}));
  CHECK(group.learn_identity({2, 1}));
  CHECK(group.normal({2}) == Word{1});
  CHECK(group.commute(0, 2));
  CHECK(group.learn_identity({0, 1, 0}));
  CHECK(group.normal({2, 1, 0}) == Word{0});
  CHECK(group.trivial(1));
}
