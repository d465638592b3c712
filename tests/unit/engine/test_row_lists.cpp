// SPDX-License-Identifier: MIT
#include "engine/row_lists.h"

#include <doctest/doctest.h>

#include <random>
#include <vector>

using namespace gmsim;

namespace {

std::vector<int> contents(const engine::RowLists<int>& lists, std::size_t row) {
  return {lists[row].begin(), lists[row].end()};
}

}  // namespace

TEST_CASE("lists have the room that was asked for, and more when they need it") {
  engine::RowLists<int> lists;
  lists.rebuild(3, [](std::size_t row) { return static_cast<std::uint32_t>(row); });
  CHECK(lists.rows() == 3);
  CHECK(lists[2].empty());
  lists.append(0, 5);  // there was no room at all
  lists.append(2, 7);
  lists.insert(2, 0, 6);
  lists.insert(2, 1, 8);
  CHECK(contents(lists, 0) == std::vector{5});
  CHECK(contents(lists, 1).empty());
  CHECK(contents(lists, 2) == std::vector{6, 8, 7});
  lists.erase(2, 1);
  CHECK(contents(lists, 2) == std::vector{6, 7});
  lists.entries(2)[1] = 9;
  CHECK(contents(lists, 2) == std::vector{6, 9});
  lists.clear(2);
  CHECK(lists[2].empty());
  lists.grow(2);  // rows are never taken away
  CHECK(lists.rows() == 3);
  CHECK_THROWS_AS(lists.erase(2, 0), support::InternalError);
}

TEST_CASE("random changes of lists are those of vectors") {
  constexpr std::uint32_t kSeed = 5;
  CAPTURE(kSeed);
  std::mt19937 random(kSeed);
  engine::RowLists<int> lists;
  std::vector<std::vector<int>> expected(6);
  lists.rebuild(expected.size(), [](std::size_t row) { return row == 3 ? 0u : 2u; });
  for (int change = 0; change < 3000; ++change) {
    CAPTURE(change);
    if (change % 400 == 399) {
      expected.emplace_back();
      lists.grow(expected.size());
    }
    const std::size_t row = random() % expected.size();
    std::vector<int>& list = expected[row];
    const std::size_t at = random() % (list.size() + 1);
    if (random() % 9 < 5) {
      lists.insert(row, at, change);
      list.insert(list.begin() + static_cast<std::ptrdiff_t>(at), change);
    } else if (at < list.size()) {
      lists.erase(row, at);
      list.erase(list.begin() + static_cast<std::ptrdiff_t>(at));
    }
    for (std::size_t k = 0; k < expected.size(); ++k) REQUIRE(contents(lists, k) == expected[k]);
  }
}
