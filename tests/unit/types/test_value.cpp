// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "support/check.h"
#include "types/value.h"

using namespace gmsim::types;

TEST_CASE("numbers read back as the same bits") {
  const std::uint64_t seed = 42;
  INFO("seed ", seed);
  std::mt19937_64 random(seed);
  for (int i = 0; i < 20000; ++i) {
    const double x = std::bit_cast<double>(random());
    if (!std::isfinite(x)) continue;
    REQUIRE(std::strtod(number_text(x).c_str(), nullptr) == x);
  }
}

TEST_CASE("numbers print with no more digits than they need") {
  CHECK(number_text(0.1) == "0.1");
  CHECK(number_text(3.0) == "3");
  CHECK(number_text(-0.0) == "-0");
  CHECK(number_text(1e300) == "1e+300");
  CHECK(number_text(1.0 / 3) == "0.3333333333333333");
  CHECK(number_text(std::numeric_limits<double>::quiet_NaN()) == "nan");
  CHECK(number_text(-std::numeric_limits<double>::infinity()) == "-inf");
}

TEST_CASE("values of every kind print") {
  CHECK(to_string(Value::boolean(true)) == "true");
  CHECK(to_string(Value::integer(-7)) == "-7");
  CHECK(to_string(Value::vec3(0, 1.5, -2)) == "(0, 1.5, -2)");
  CHECK(to_string(Value{{ValueKind::Mat2}, {1, 2, 3, 4}}) == "((1, 2), (3, 4))");
  CHECK(to_string(Value{{ValueKind::Sym3}, {1, 2, 3, 4, 5, 6}}) == "(1, 2, 3, 4, 5, 6)");
  CHECK(to_string(Value{{ValueKind::Vec2, {2}}, {1, 2, 3, 4}}) == "[(1, 2), (3, 4)]");
  CHECK(to_string(Value{{ValueKind::Bool, {2}}, {1, 0}}) == "[true, false]");
  CHECK(to_string(Value::of_dart(DartId{96})) == "dart 96");
  CHECK(to_string(Value::of_dart(kNoDart)) == "no dart");
  CHECK(to_string(Value{{ValueKind::Darts}, {}, kNoDart, {DartId{1}, DartId{4}}}) == "{1, 4}");
  CHECK(to_string(Value{{ValueKind::Forces}, {1, 2, 3, 4, 5, 6}}) == "{(1, 2, 3), (4, 5, 6)}");
  CHECK(to_string(Value{{ValueKind::Range}, {0, 8}}) == "0..8");
  CHECK(to_string(Value{{ValueKind::EigenPair}, {2, 0, 0, 1}}) == "{ value 2, vector (0, 0, 1) }");
  CHECK(to_string(Value{{ValueKind::Zero}}) == "0");
}

TEST_CASE("a value that lacks components is our mistake") {
  CHECK_THROWS_AS((void)to_string(Value{{ValueKind::Vec3}, {1, 2}}), gmsim::support::InternalError);
}

TEST_CASE("zeros have all their components") {
  const Value zero = Value::zero({ValueKind::Mat3, {2}});
  CHECK(zero.data == std::vector<double>(18, 0.0));
  CHECK(zero.finite());
}

TEST_CASE("one component that is not finite spoils a value") {
  CHECK_FALSE(Value::vec3(0, std::nan(""), 0).finite());
  CHECK_FALSE(Value::real(std::numeric_limits<double>::infinity()).finite());
}
