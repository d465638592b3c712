// SPDX-License-Identifier: MIT
// The functions that kernels compute in a fixed order, against the C library in long double.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>

#include "engine/builtins.h"
#include "engine/kernel/lane_functions.h"

using namespace gmsim;
namespace fixed = engine::fixed_order;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The distance in units of the last place of the exact value.
double error_in_ulps(double got, long double exact) {
  if (std::isnan(got) && std::isnan(exact)) return 0;
  const double nearest = static_cast<double>(exact);
  if (got == nearest) return 0;
  const double step = std::nextafter(std::abs(nearest), kInfinity) - std::abs(nearest);
  return static_cast<double>(std::abs(got - exact) / step);
}

using Real = std::function<double(double)>;
using Exact = std::function<long double(long double)>;

double worst(const Real& function, const Exact& exact, const std::function<double()>& next) {
  double result = 0, at = 0;
  for (int i = 0; i < 200000; ++i) {
    const double x = next();
    const double got = function(x);
    const double error = error_in_ulps(got, exact(x));
    if (!(error <= result)) {
      result = error;
      at = x;
    }
  }
  MESSAGE("largest error ", result, " ulp, at ", at);
  return result;
}

std::function<double()> uniform(double lo, double hi) {
  return [=, random = std::mt19937_64(1)]() mutable {
    return std::uniform_real_distribution<double>(lo, hi)(random);
  };
}
/// Of every magnitude from 2^lo to 2^hi, both signs or one.
std::function<double()> any_size(double lo, double hi, bool signs = true) {
  return [=, random = std::mt19937_64(2)]() mutable {
    const double size = std::exp2(std::uniform_real_distribution<double>(lo, hi)(random));
    return signs && random() % 2 == 0 ? -size : size;
  };
}

}  // namespace

TEST_CASE("exponentials and logarithms are accurate") {
  const auto exact = [](long double x) { return std::exp(x); };
  CHECK(worst(fixed::exp, exact, uniform(-1, 1)) < 1);
  CHECK(worst(fixed::exp, exact, uniform(-745, 709.7)) < 1);
  CHECK(worst(fixed::exp, exact, any_size(-60, 9)) < 1);
  const auto exact_log = [](long double x) { return std::log(x); };
  CHECK(worst(fixed::log, exact_log, uniform(0.5, 2)) < 1);
  CHECK(worst(fixed::log, exact_log, any_size(-1074, 1023.9, false)) < 1);
}

TEST_CASE("trigonometric functions are accurate, for large angles too") {
  const auto sine = [](long double x) { return std::sin(x); };
  const auto cosine = [](long double x) { return std::cos(x); };
  const auto tangent = [](long double x) { return std::tan(x); };
  for (const auto& next : {uniform(-4, 4), any_size(-40, 20), any_size(15, 60)}) {
    CHECK(worst(fixed::sin, sine, next) < 1);
    CHECK(worst(fixed::cos, cosine, next) < 1);
    CHECK(worst(fixed::tan, tangent, next) < 2.5);
  }
  // Values of the C library in double for arguments beyond the range of its long double reduction.
  for (const double x :
       {1e22, 1.7e308, 5.319372648326541e255, -3e100, 6381956970095103 * 0x1p797}) {
    CHECK(std::abs(fixed::sin(x) - std::sin(x)) <= 1.2e-16);
    CHECK(std::abs(fixed::cos(x) - std::cos(x)) <= 1.2e-16);
  }
  CHECK(std::abs(fixed::cos(6381956970095103 * 0x1p797) / -4.68716592425462761112e-19 - 1) < 1e-15);
}

TEST_CASE("angles are accurate") {
  const auto atan = [](long double x) { return std::atan(x); };
  CHECK(worst(fixed::atan, atan, uniform(-4, 4)) < 1.5);
  CHECK(worst(fixed::atan, atan, any_size(-60, 60)) < 1.5);
  CHECK(worst(
            fixed::asin, [](long double x) { return std::asin(x); }, uniform(-1, 1)) < 2.5);
  CHECK(worst(
            fixed::asin, [](long double x) { return std::asin(x); }, any_size(-60, 0)) < 2.5);
  CHECK(worst(
            fixed::acos, [](long double x) { return std::acos(x); }, uniform(-1, 1)) < 2.5);
  CHECK(worst(
            fixed::acos, [](long double x) { return std::acos(x); }, any_size(-60, 0)) < 2.5);
  auto size = any_size(-40, 40);
  double y = 0;
  const auto atan2 = [&](double x) { return fixed::atan2(y = size(), x); };
  CHECK(worst(
            atan2, [&](long double x) { return std::atan2(static_cast<long double>(y), x); },
            any_size(-42, 42)) < 1.5);
}

TEST_CASE("hyperbolic tangents and powers are accurate") {
  const auto tanh = [](long double x) { return std::tanh(x); };
  CHECK(worst(fixed::tanh, tanh, uniform(-3, 3)) < 1.5);
  CHECK(worst(fixed::tanh, tanh, any_size(-60, 10)) < 1.5);
  auto exponent = uniform(-40, 40);
  double y = 0;
  CHECK(worst([&](double x) { return engine::general_power(x, y = exponent()); },
              [&](long double x) { return std::pow(x, static_cast<long double>(y)); },
              any_size(-20, 20, false)) < 1.5);
}

TEST_CASE("limits are those of the C library") {
  const double special[] = {
      0.0,        -0.0,    1.0,      -1.0,   0.5, -2.0,
      1e-310,     -4e-320, 1e300,    -1e300, 1.5, kInfinity,
      -kInfinity, NAN,     5e-324,   0.66,   2.4, std::numeric_limits<double>::max(),
      709.78,     -745.1,  1.0000001};
  const auto same = [](double got, double expected) {
    if (std::isnan(expected)) return std::isnan(got);
    if (std::signbit(got) != std::signbit(expected)) return false;
    return got == expected || std::abs(got - expected) <= 5e-16 * std::abs(expected) + 1e-323;
  };
  const struct {
    const char* name;
    double (*ours)(double);
    double (*theirs)(double);
  } functions[] = {{"exp", fixed::exp, std::exp},    {"log", fixed::log, std::log},
                   {"sin", fixed::sin, std::sin},    {"cos", fixed::cos, std::cos},
                   {"tan", fixed::tan, std::tan},    {"asin", fixed::asin, std::asin},
                   {"acos", fixed::acos, std::acos}, {"atan", fixed::atan, std::atan},
                   {"tanh", fixed::tanh, std::tanh}};
  for (const auto& function : functions) {
    CAPTURE(std::string(function.name));
    for (const double x : special) {
      CAPTURE(x);
      CHECK(same(function.ours(x), function.theirs(x)));
    }
  }
  for (const double x : special) {
    for (const double y : special) {
      CAPTURE(x);
      CAPTURE(y);
      CHECK(same(fixed::atan2(x, y), std::atan2(x, y)));
      const bool root = y == 0.5 && std::signbit(x);  // a square root, by definition
      if (!root) CHECK(same(engine::power(x, y), std::pow(x, y)));
    }
  }
}
