// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <numbers>
#include <random>
#include <set>

#include "types/unit.h"

using namespace gmsim::types;

namespace {

Unit unit(std::string_view name) {
  INFO(name);
  const auto found = named_unit(name);
  REQUIRE(found.has_value());
  return found->unit;
}

double scale(std::string_view name) {
  INFO(name);
  const auto found = named_unit(name);
  REQUIRE(found.has_value());
  return found->scale;
}

Unit random_unit(std::mt19937& random) {
  Unit result;
  for (auto& exponent : result.exponents)
    exponent = static_cast<std::int16_t>(static_cast<int>(random() % 97) - 48);
  return result;
}

}  // namespace

TEST_CASE("units multiply, divide and take powers as exponents do") {
  const unsigned seed = 3;
  INFO("seed ", seed);
  std::mt19937 random(seed);
  for (int i = 0; i < 500; ++i) {
    const Unit a = random_unit(random);
    const Unit b = random_unit(random);
    CHECK(a * b == b * a);
    CHECK((a * b) / b == a);
    CHECK((a / a).dimensionless());
    CHECK(power(a, 3) == a * a * a);
    CHECK(power(a, -1) == Unit{} / a);
    CHECK(power(a * a, 1, 2) == a);
    CHECK(power(a, 0) == Unit{});
  }
}

TEST_CASE("a power that twelfths cannot hold has no unit") {
  CHECK(power(unit("m"), 1, 12).has_value());
  CHECK_FALSE(power(unit("m"), 1, 5).has_value());
  CHECK_FALSE(power(unit("m"), 1, 0).has_value());
  CHECK_FALSE(power(unit("m"), 3000).has_value());
}

TEST_CASE("products of any length are safe") {
  Unit huge = unit("J");
  for (int i = 0; i < 40; ++i) huge = huge * huge;
  CHECK_FALSE(huge.dimensionless());
}

TEST_CASE("derived units are what their definitions say") {
  CHECK(unit("N") == unit("kg") * unit("m") / (unit("s") * unit("s")));
  CHECK(unit("Pa") == unit("N") / (unit("m") * unit("m")));
  CHECK(unit("J") == unit("N") * unit("m"));
  CHECK(unit("W") == unit("J") / unit("s"));
  CHECK(unit("Hz") == unit("1") / unit("s"));
  CHECK(unit("V") == unit("W") / unit("A"));
  CHECK(unit("C") == unit("A") * unit("s"));
  CHECK(unit("L") == unit("m") * unit("m") * unit("m"));
  CHECK(unit("rad").dimensionless());
  CHECK(unit("deg").dimensionless());
}

TEST_CASE("prefixes scale exactly") {
  CHECK(scale("mm") == 1e-3);
  CHECK(scale("um") == 1e-6);
  CHECK(scale("km") == 1e3);
  CHECK(scale("kg") == 1.0);
  CHECK(scale("g") == 1e-3);
  CHECK(scale("mg") == 1e-6);
  CHECK(scale("min") == 60.0);
  CHECK(scale("h") == 3600.0);
  CHECK(scale("GPa") == 1e9);
  CHECK(scale("L") == 1e-3);
  CHECK(scale("mL") == 1e-6);
  CHECK(scale("bar") == 1e5);
  CHECK(scale("deg") == std::numbers::pi / 180);
}

TEST_CASE("the list of names is exactly what is understood") {
  std::set<std::string> names;
  for (const std::string& name : unit_names()) {
    CHECK(names.insert(name).second);
    CHECK(named_unit(name).has_value());
  }
  for (const char* name : {"", "k", "Mm", "kkg", "kmin", "newton", "n", "mmm", "k1"})
    CHECK_FALSE(named_unit(name).has_value());
}

TEST_CASE("well-known combinations print by name, others by their bases") {
  const Unit m = unit("m");
  const Unit s = unit("s");
  CHECK(to_string(unit("N")) == "N");
  CHECK(to_string(unit("N") / m) == "N/m");
  CHECK(to_string(unit("N") * s / m) == "N s/m");
  CHECK(to_string(unit("MPa")) == "Pa");
  CHECK(to_string(unit("J") / (m * m)) == "N/m");
  CHECK(to_string(Unit{}) == "1");
  CHECK(to_string(unit("Hz")) == "1/s");
  CHECK(to_string(m / s) == "m/s");
  CHECK(to_string(m / (s * s)) == "m/s^2");
  CHECK(to_string(unit("kg") / (m * m * m)) == "kg/m^3");
  CHECK(to_string(unit("N") * s) == "kg m/s");
  CHECK(to_string(unit("kg") / (unit("K") * s)) == "kg/(s K)");
  CHECK(to_string(*power(m, 1, 2)) == "m^(1/2)");
  CHECK(to_string(*power(m, -2, 3)) == "1/m^(2/3)");
}
