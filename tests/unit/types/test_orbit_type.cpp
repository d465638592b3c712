// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "types/orbit_type.h"

using gmsim::types::OrbitType;

TEST_CASE("orbit types print as in the paper") {
  CHECK(to_string(OrbitType{}) == "<>");
  CHECK(to_string(OrbitType{2}) == "<2>");
  CHECK(to_string(OrbitType{2, 0}) == "<0,2>");
  CHECK(to_string(OrbitType::range(0, 3)) == "<0,1,2,3>");
}

TEST_CASE("a cell leaves out its own link") {
  CHECK(OrbitType::cell(0, 2) == OrbitType{1, 2});
  CHECK(OrbitType::cell(1, 3) == OrbitType{0, 2, 3});
  CHECK(OrbitType::cell(1, 1) == OrbitType{0});
}

TEST_CASE("a range that ends before it begins is the single dart") {
  CHECK(OrbitType::range(0, -1).empty());
  CHECK(OrbitType::range(1, 1) == OrbitType{1});
}

TEST_CASE("sets contain and meet each other as sets do") {
  for (std::uint8_t a = 0; a < 16; ++a)
    for (std::uint8_t b = 0; b < 16; ++b) {
      const OrbitType left = OrbitType::from_bits(a);
      const OrbitType right = OrbitType::from_bits(b);
      bool subset = true;
      bool common = false;
      for (int i = 0; i <= gmsim::types::kMaxDimension; ++i) {
        subset = subset && (left.contains(i) || !right.contains(i));
        common = common || (left.contains(i) && right.contains(i));
      }
      CHECK(left.contains(right) == subset);
      CHECK(left.meets(right) == common);
    }
}
