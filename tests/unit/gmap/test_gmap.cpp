// SPDX-License-Identifier: MIT
#include "gmap/gmap.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "gmap/validate.h"
#include "support/mesh_groups.h"

using namespace gmsim;
using namespace gmsim::gmap;

namespace {

DartId dart(std::uint32_t d) {
  return DartId{d};
}

/// Two separate squares; 2-sewing their facing sides is what the tests do.
GMap two_squares() {
  Mesh mesh = gmap::grid(2, 1, 2.0, 1.0, GridCells::Quads);
  GMap map = build_map(mesh).map;
  map.unsew(2, dart(2));
  return map;
}

}  // namespace

TEST_CASE("new darts are free and numbered in order") {
  GMap map(3);
  CHECK(map.dart_end() == 0);
  CHECK(map.add_dart() == dart(0));
  CHECK(map.add_darts(3) == dart(1));
  CHECK(map.dart_count() == 4);
  for (std::uint32_t d = 0; d < 4; ++d) {
    for (int i = 0; i <= 3; ++i) CHECK(map.is_free(i, dart(d)));
  }
  CHECK_FALSE(map.alive(dart(4)));
  CHECK_FALSE(map.alive(types::kNoDart));
}

TEST_CASE("a map has dimension 1, 2 or 3") {
  CHECK_THROWS_AS(GMap(0), support::InternalError);
  CHECK_THROWS_AS(GMap(4), support::InternalError);
}

TEST_CASE("link wants two different free darts, unlink a linked one") {
  GMap map(2);
  map.add_darts(3);
  map.link(1, dart(0), dart(1));
  CHECK(map.alpha(1, dart(0)) == dart(1));
  CHECK(map.alpha(1, dart(1)) == dart(0));
  CHECK_THROWS_AS(map.link(1, dart(1), dart(2)), support::InternalError);
  CHECK_THROWS_AS(map.link(1, dart(2), dart(2)), support::InternalError);
  CHECK_THROWS_AS(map.unlink(1, dart(2)), support::InternalError);
  map.unlink(1, dart(1));
  CHECK(map.is_free(1, dart(0)));
  CHECK(map.is_free(1, dart(1)));
}

TEST_CASE("sewing edges links both their ends") {
  GMap map = two_squares();
  // Dart 2 runs up the right side of the first square, dart 15 up the left side of the second.
  std::vector<DartId> touched;
  REQUIRE(map.sew(2, dart(2), dart(15), &touched));
  CHECK(map.alpha(2, dart(2)) == dart(15));
  CHECK(map.alpha(2, dart(3)) == dart(14));
  CHECK(touched == std::vector{dart(2), dart(15), dart(3), dart(14)});
  CHECK_FALSE(map.sew(2, dart(2), dart(15)));
  touched.clear();
  map.unsew(2, dart(14), &touched);
  CHECK(touched.size() == 4);
  CHECK(map.is_free(2, dart(2)));
  CHECK(map.is_free(2, dart(3)));
}

TEST_CASE("unsewing what is free changes nothing") {
  GMap map = two_squares();
  std::vector<DartId> touched;
  map.unsew(2, dart(0), &touched);
  CHECK(touched.empty());
}

TEST_CASE("faces with different numbers of corners cannot be 3-sewn") {
  GMap map(3);
  map.add_darts(14);
  for (auto [first, corners] : {std::pair{0u, 3u}, std::pair{6u, 4u}}) {
    for (std::uint32_t c = 0; c < corners; ++c) {
      map.link(0, dart(first + 2 * c), dart(first + 2 * c + 1));
      map.link(1, dart(first + 2 * c + 1), dart(first + (2 * c + 2) % (2 * corners)));
    }
  }
  CHECK_FALSE(map.can_sew(3, dart(0), dart(6)));
  CHECK_FALSE(map.can_sew(3, dart(0), dart(0)));
  CHECK_FALSE(map.can_sew(3, dart(0), dart(1)));  // the same face
}

TEST_CASE("removed darts keep their ids and lose their links") {
  GMap map = two_squares();
  std::vector<DartId> face;
  for (std::uint32_t d = 8; d < 16; ++d) face.push_back(dart(d));
  map.remove_darts(face);
  CHECK(map.dart_count() == 8);
  CHECK(map.dart_end() == 16);
  CHECK_FALSE(map.alive(dart(8)));
  CHECK(map.alpha(0, dart(8)) == types::kNoDart);
  CHECK(validate(map).empty());
  CHECK(map.add_dart() == dart(16));
}

TEST_CASE("a dart that is still linked to an alive one cannot be removed") {
  GMap map = two_squares();
  CHECK_THROWS_AS(map.remove_dart(dart(8)), support::InternalError);
  GMap again = two_squares();
  again.remove_darts(
      std::vector{dart(0), dart(1), dart(2), dart(3), dart(4), dart(5), dart(6), dart(7)});
  CHECK_THROWS_AS(again.remove_dart(dart(0)), support::InternalError);
}
