// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "engine/builtins.h"

using namespace gmsim;
using types::Builtin;

namespace {

using Matrix = std::array<double, 9>;
constexpr std::uint64_t kSeed = 7;

std::vector<double> call(Builtin function, int overload,
                         const std::vector<std::vector<double>>& arguments, std::size_t results) {
  engine::BuiltinCall call;
  call.overload = overload;
  for (std::size_t i = 0; i < arguments.size(); ++i) call.arguments[i] = arguments[i].data();
  std::vector<double> out(results);
  engine::builtin_function(function)(call, out.data());
  return out;
}
double scalar(Builtin function, int overload, const std::vector<std::vector<double>>& arguments) {
  return call(function, overload, arguments, 1)[0];
}

Matrix multiply(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) c[3 * i + j] += a[3 * i + k] * b[3 * k + j];
    }
  }
  return c;
}
Matrix transposed(const Matrix& a) {
  return {a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8]};
}
double det(const Matrix& a) {
  return a[0] * (a[4] * a[8] - a[5] * a[7]) - a[1] * (a[3] * a[8] - a[5] * a[6]) +
         a[2] * (a[3] * a[7] - a[4] * a[6]);
}
double distance(const Matrix& a, const Matrix& b) {
  double largest = 0.0;
  for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}
double trace_product(const Matrix& a, const Matrix& b) {
  double sum = 0.0;
  for (int i = 0; i < 9; ++i) sum += a[i] * b[i];
  return sum;
}
constexpr Matrix kIdentity = {1, 0, 0, 0, 1, 0, 0, 0, 1};

class Numbers {
 public:
  double operator()() { return uniform_(random_); }
  Matrix matrix() {
    Matrix m;
    for (double& x : m) x = (*this)();
    return m;
  }
  /// From a random unit quaternion.
  Matrix rotation() {
    double w = (*this)(), x = (*this)(), y = (*this)(), z = (*this)();
    const double n = std::sqrt(w * w + x * x + y * y + z * z);
    w /= n, x /= n, y /= n, z /= n;
    return {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
            2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
            2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
  }

 private:
  std::mt19937_64 random_{kSeed};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

Matrix polar(const Matrix& f) {
  Matrix r;
  engine::polar_rotation3(f.data(), r.data());
  return r;
}
Matrix scaled(Matrix m, double s) {
  for (double& x : m) x *= s;
  return m;
}
/// U diag(values) V^T with random rotations.
Matrix with_singular_values(Numbers& numbers, std::array<double, 3> values) {
  const Matrix diagonal = {values[0], 0, 0, 0, values[1], 0, 0, 0, values[2]};
  return multiply(multiply(numbers.rotation(), diagonal), numbers.rotation());
}

void check_eigenpairs(const std::array<double, 6>& s) {
  double values[3], v[3][3];
  engine::eigen_symmetric3(s.data(), values, v);
  double size = 0.0;
  for (double x : s) size = std::max(size, std::abs(x));
  const Matrix full = {s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2]};
  CHECK(values[0] >= values[1]);
  CHECK(values[1] >= values[2]);
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) {
      double product = 0.0;
      for (int j = 0; j < 3; ++j) product += full[3 * i + j] * v[k][j];
      CHECK(std::abs(product - values[k] * v[k][i]) <= 2e-15 * size);
    }
    for (int l = 0; l < 3; ++l) {
      const double dot = v[k][0] * v[l][0] + v[k][1] * v[l][1] + v[k][2] * v[l][2];
      CHECK(std::abs(dot - (k == l ? 1.0 : 0.0)) < 2e-15);
    }
  }
}

}  // namespace

TEST_CASE("eigenpairs of symmetric matrices of any shape and size") {
  Numbers numbers;
  CAPTURE(kSeed);
  for (double scale : {1.0, 1e-150, 1e150, 1e-300}) {
    for (int round = 0; round < 200; ++round) {
      std::array<double, 6> s;
      for (double& x : s) x = scale * numbers();
      if (round % 4 == 1) s[3] = s[4] = s[5] = 0.0;
      if (round % 4 == 2) s = {s[0], s[0], s[0], 1e-9 * s[1], 0.0, 0.0};
      if (round % 4 == 3) {  // rank one
        const double x = s[0] / scale, y = s[1] / scale, z = s[2];
        s = {scale * x * x, scale * y * y, z * (z / scale), y * z, x * z, scale * x * y};
      }
      check_eigenpairs(s);
    }
  }
  check_eigenpairs({0, 0, 0, 0, 0, 0});
  check_eigenpairs({2, 2, 2, 0, 0, 0});
  check_eigenpairs({1, 1, 1, 1, 1, 1});
}

TEST_CASE("the eigenpair builtins give value and vector") {
  const auto largest = call(Builtin::MaxEigenpair, 0, {{1, 5, 2, 0, 0, 0}}, 4);
  CHECK(largest == std::vector<double>{5, 0, 1, 0});
  const auto smallest = call(Builtin::MinEigenpair, 0, {{1, 5, 2, 0, 0, 0}}, 4);
  CHECK(smallest == std::vector<double>{1, 1, 0, 0});
}

TEST_CASE("the polar rotation is proper and closest, for inverted and singular matrices too") {
  Numbers numbers;
  CAPTURE(kSeed);
  for (double scale : {1.0, 1e-150, 1e150}) {
    for (int round = 0; round < 300; ++round) {
      Matrix f = numbers.matrix();
      if (round % 6 == 1) f = with_singular_values(numbers, {1.0, 0.7, 0.0});
      if (round % 6 == 2) f = with_singular_values(numbers, {1.0, 0.0, 0.0});
      if (round % 6 == 3) f = with_singular_values(numbers, {1.0, 0.7, -0.3});
      if (round % 6 == 4) f = with_singular_values(numbers, {1.0, 1e-9, 1e-12});
      f = scaled(f, scale);
      CAPTURE(round);
      const Matrix r = polar(f);
      CHECK(distance(multiply(transposed(r), r), kIdentity) < 4e-15);
      CHECK(std::abs(det(r) - 1.0) < 4e-15);
      const Matrix s = multiply(transposed(r), f);
      CHECK(distance(s, transposed(s)) < 4e-15 * scale);
      const double best = trace_product(r, f);
      for (int other = 0; other < 5; ++other) {
        CHECK(trace_product(numbers.rotation(), f) <= best + 1e-13 * scale);
      }
    }
  }
}

TEST_CASE("the polar rotation turns with its matrix") {
  Numbers numbers;
  for (int round = 0; round < 100; ++round) {
    const Matrix f = with_singular_values(numbers, {1.5, 1.0, round % 2 == 0 ? 0.5 : -0.4});
    const Matrix q = numbers.rotation();
    CHECK(distance(polar(multiply(q, f)), multiply(q, polar(f))) < 2e-14);
  }
}

TEST_CASE("the polar rotation of nothing and of a stretched line is the least one") {
  CHECK(polar({}) == kIdentity);
  CHECK(distance(polar({2, 0, 0, 0, 0, 0, 0, 0, 0}), kIdentity) < 1e-15);
  // e1 -> e2: a quarter turn about e3
  CHECK(distance(polar({0, 0, 0, 3, 0, 0, 0, 0, 0}), {0, -1, 0, 1, 0, 0, 0, 0, 1}) < 1e-15);
  const Matrix flipped = polar({-1, 0, 0, 0, 0, 0, 0, 0, 0});
  CHECK(std::abs(flipped[0] + 1) < 1e-15);
  CHECK(std::abs(det(flipped) - 1) < 1e-15);
}

TEST_CASE("the polar rotation of 2x2 matrices") {
  const auto r = call(Builtin::PolarRotation, 1, {{0, -2, 3, 0}}, 4);
  CHECK(r == std::vector<double>{0, -1, 1, 0});
  CHECK(call(Builtin::PolarRotation, 1, {{0, 0, 0, 0}}, 4) == std::vector<double>{1, 0, 0, 1});
}

TEST_CASE("lengths and directions of very short and very long vectors") {
  for (double scale : {1.0, 1e-200, 1e200, 5e-324}) {
    const double norm = scalar(Builtin::Norm, 0, {{3 * scale, 4 * scale, 0}});
    CHECK(norm == doctest::Approx(5 * scale).epsilon(1e-14));
    const auto unit = call(Builtin::Normalize, 0, {{3 * scale, 4 * scale, 0}}, 3);
    CHECK(unit[0] == doctest::Approx(0.6).epsilon(1e-14));
    CHECK(unit[1] == doctest::Approx(0.8).epsilon(1e-14));
  }
  CHECK(call(Builtin::Normalize, 0, {{0, 0, 0}}, 3) == std::vector<double>{0, 0, 0});
  CHECK(scalar(Builtin::Norm, 2, {{-3}}) == 3);
}

TEST_CASE("whole numbers and rounding") {
  CHECK(scalar(Builtin::Mod, 0, {{-7}, {3}}) == 2);
  CHECK(scalar(Builtin::Mod, 0, {{7}, {-3}}) == -2);
  CHECK(scalar(Builtin::Mod, 1, {{6}, {3}}) == 0);
  CHECK(scalar(Builtin::Sign, 0, {{-2.5}}) == -1);
  CHECK(scalar(Builtin::Sign, 0, {{0}}) == 0);
  CHECK(scalar(Builtin::Clamp, 0, {{5}, {0}, {2}}) == 2);
  CHECK(engine::power(2, 10) == 1024);
  CHECK(engine::power(2, -2) == 0.25);
  CHECK(engine::power(9, 0.5) == 3);
  CHECK(engine::power(0, 0) == 1);
  CHECK(engine::power(2, 1.5) == doctest::Approx(std::pow(2, 1.5)));
}

TEST_CASE("inverse, determinant and products agree for full and symmetric matrices") {
  Numbers numbers;
  for (int round = 0; round < 20; ++round) {
    std::vector<double> s(6);
    for (double& x : s) x = numbers();
    const auto full = call(Builtin::Mat, 0, {s}, 9);
    CHECK(scalar(Builtin::Det, 2, {s}) == scalar(Builtin::Det, 0, {full}));
    CHECK(scalar(Builtin::Trace, 2, {s}) == scalar(Builtin::Trace, 0, {full}));
    CHECK(scalar(Builtin::Contract, 1, {s, s}) ==
          doctest::Approx(scalar(Builtin::Contract, 0, {full, full})).epsilon(1e-14));
    CHECK(call(Builtin::Sym, 0, {full}, 6) == s);
    const auto inverse = call(Builtin::Inverse, 0, {full}, 9);
    Matrix a, b;
    std::copy(full.begin(), full.end(), a.begin());
    std::copy(inverse.begin(), inverse.end(), b.begin());
    CHECK(distance(multiply(a, b), kIdentity) < 1e-10);
    CHECK(call(Builtin::Sym, 0, {inverse}, 6) == call(Builtin::Inverse, 2, {s}, 6));
  }
  CHECK(call(Builtin::Inverse, 1, {{2, 0, 0, 4}}, 4) == std::vector<double>{0.5, 0, 0, 0.25});
}
