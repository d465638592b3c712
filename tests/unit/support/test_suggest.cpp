// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "support/suggest.h"

using namespace gmsim::support;

namespace {

/// All words one slip away: a letter left out, added, changed, or two neighbours swapped.
std::vector<std::string> one_slip_away(const std::string& word) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < word.size(); ++i) {
    words.push_back(word.substr(0, i) + word.substr(i + 1));
    words.push_back(word.substr(0, i) + '#' + word.substr(i));
    words.push_back(word.substr(0, i) + '#' + word.substr(i + 1));
    std::string swapped = word;
    if (i > 0) std::swap(swapped[i - 1], swapped[i]);
    if (swapped != word) words.push_back(swapped);
  }
  return words;
}

}  // namespace

TEST_CASE("every single slip in a name of four letters or more is recognised") {
  for (const std::string name : {"left", "right", "velocity", "corner_mass"})
    for (const std::string& typed : one_slip_away(name)) {
      INFO(typed);
      CHECK(close_names(typed, {name}) == std::vector<std::string>{name});
    }
}

TEST_CASE("no more than a third of the letters may differ") {
  CHECK(close_names("abcdef", {"abcdxy"}).size() == 1);
  CHECK(close_names("abcdef", {"abcxyz"}).empty());
  CHECK(close_names("ab", {"ac"}).empty());
  CHECK(close_names("", {"a"}).empty());
}

TEST_CASE("the name itself is no suggestion") {
  CHECK(close_names("mass", {"mass"}).empty());
}

TEST_CASE("the nearest come first, three at most, whatever the order of the candidates") {
  std::vector<std::string> candidates = {"stifness", "stiffnes", "stffnes", "stiffnesss", "mass"};
  std::sort(candidates.begin(), candidates.end());
  do {
    CHECK(close_names("stiffness", candidates) ==
          std::vector<std::string>{"stiffnes", "stiffnesss", "stifness"});
  } while (std::next_permutation(candidates.begin(), candidates.end()));
}

TEST_CASE("suggestions are written as a question") {
  CHECK(did_you_mean("rihgt", {"left", "right"}) == "did you mean `right`?");
  CHECK(did_you_mean("abcd", {"abce", "abcf"}) == "did you mean `abce` or `abcf`?");
  CHECK(did_you_mean("abcd", {"abce", "abcf", "abcg"}) == "did you mean `abce`, `abcf` or `abcg`?");
  CHECK(did_you_mean("gravity", {"left", "right"}).empty());
}

TEST_CASE("a name that nobody typed by hand is compared with nothing") {
  const std::string name(100000, 'a');
  CHECK(close_names(name, {name + "b"}).empty());
}
