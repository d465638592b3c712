// SPDX-License-Identifier: MIT
#include "engine/stability_lanczos.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/integrators/vertex_record_math.h"

namespace gmsim::engine {
namespace {

using Vector = std::vector<VertexRecord>;

double product(const Vector& a, const Vector& b) {
  double sum = 0;
  for (std::size_t r = 0; r < a.size(); ++r) sum += dot(a[r], b[r]);
  return sum;
}
void add(Vector& to, double factor, const Vector& from) {
  for (std::size_t r = 0; r < to.size(); ++r) to[r] = to[r] + factor * from[r];
}
void scale(Vector& vector, double factor) {
  for (VertexRecord& record : vector) record = factor * record;
}

/// Numbers in [-1.5, -0.5] or [0.5, 1.5] from a hash, so that no mode is missed by symmetry.
Vector start_vector(std::span<const double> free) {
  Vector start(free.size());
  std::uint64_t hash = 0x9e3779b97f4a7c15ull;
  const auto draw = [&] {
    hash ^= hash >> 12;
    hash ^= hash << 25;
    hash ^= hash >> 27;
    const std::uint64_t bits = hash * 0x2545f4914f6cdd1dull;
    const double size = 0.5 + static_cast<double>(bits >> 11) * 0x1p-53;
    return (bits & 1) != 0 ? size : -size;
  };
  for (std::size_t r = 0; r < free.size(); ++r) {
    const VertexRecord drawn{draw(), draw(), draw()};
    if (free[r] != 0) start[r] = drawn;
  }
  return start;
}

/// The symmetric tridiagonal matrix of the recurrence.
struct Tridiagonal {
  std::vector<double> diagonal, beside;  // beside[j] couples j and j + 1

  /// Eigenvalues below x (Sturm's count).
  [[nodiscard]] std::size_t below(double x) const {
    std::size_t count = 0;
    double pivot = 1;
    for (std::size_t j = 0; j < diagonal.size(); ++j) {
      const double coupling = j == 0 ? 0 : beside[j - 1] * beside[j - 1] / pivot;
      pivot = diagonal[j] - x - coupling;
      if (pivot == 0) pivot = -1e-300;
      if (pivot < 0) ++count;
    }
    return count;
  }
  /// Its `rank`-th eigenvalue from below, by bisection between Gershgorin's bounds.
  [[nodiscard]] double eigenvalue(std::size_t rank) const {
    double low = diagonal[0], high = diagonal[0];
    for (std::size_t j = 0; j < diagonal.size(); ++j) {
      const double radius = (j == 0 ? 0 : std::abs(beside[j - 1])) +
                            (j + 1 < diagonal.size() ? std::abs(beside[j]) : 0);
      low = std::min(low, diagonal[j] - radius);
      high = std::max(high, diagonal[j] + radius);
    }
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (below(middle) > rank ? high : low) = middle;
    }
    return 0.5 * (low + high);
  }
  /// A vector for an eigenvalue, by inverse iteration with a slightly shifted matrix.
  [[nodiscard]] std::vector<double> eigenvector(double value) const {
    const std::size_t n = diagonal.size();
    double size = std::abs(value);
    for (const double d : diagonal) size = std::max(size, std::abs(d));
    const double shift = value + 1e-9 * (size > 0 ? size : 1);
    std::vector<double> vector(n, 1.0);
    for (int round = 0; round < 3; ++round) {
      solve_shifted(shift, vector);
      double length = 0;
      for (const double x : vector) length = std::hypot(length, x);
      for (double& x : vector) x /= length;
    }
    return vector;
  }

 private:
  /// (T - shift) x = x, without pivoting; the shift keeps pivots away from zero.
  void solve_shifted(double shift, std::vector<double>& x) const {
    const std::size_t n = diagonal.size();
    std::vector<double> pivot(n);
    for (std::size_t j = 0; j < n; ++j) {
      pivot[j] = diagonal[j] - shift;
      if (j > 0) {
        const double factor = beside[j - 1] / pivot[j - 1];
        pivot[j] -= factor * beside[j - 1];
        x[j] -= factor * x[j - 1];
      }
      if (pivot[j] == 0) pivot[j] = 1e-300;
    }
    for (std::size_t j = n; j-- > 0;) {
      if (j + 1 < n) x[j] -= beside[j] * x[j + 1];
      x[j] /= pivot[j];
    }
  }
};

/// One pass of the recurrence; `visit(j, q)` sees every basis vector and says whether to go on.
/// False when a product failed.
template <typename Visit>
bool recurrence(const SymmetricOperator& apply, Vector q, Tridiagonal& t, const Visit& visit) {
  Vector before(q.size()), next(q.size());
  t = {};
  for (std::size_t j = 0;; ++j) {
    if (!apply(q, next)) return false;
    const double along = product(next, q);
    t.diagonal.push_back(along);
    if (!visit(j, q)) return true;
    add(next, -along, q);
    if (j > 0) add(next, -t.beside.back(), before);
    const double length = std::sqrt(product(next, next));
    if (!(length > 1e-12 * std::abs(along))) return std::isfinite(length);  // an invariant subspace
    t.beside.push_back(length);
    scale(next, 1 / length);
    std::swap(before, q);
    std::swap(q, next);
  }
}

}  // namespace

SpectrumEnds spectrum_ends(const SymmetricOperator& apply, std::span<const double> free,
                           std::uint32_t most_products) {
  SpectrumEnds ends;
  Vector start = start_vector(free);
  const double length = std::sqrt(product(start, start));
  if (length == 0) return ends;
  scale(start, 1 / length);

  Tridiagonal t;
  std::vector<double> largest;
  const std::size_t most = std::max(most_products / 2, 1u);
  const bool done = recurrence(apply, start, t, [&](std::size_t j, const Vector&) {
    largest.push_back(t.eigenvalue(j));
    const double change = j < 4 ? 1 : std::abs(largest[j] - largest[j - 4]);
    return j + 1 < most && (j < 8 || change > 5e-4 * std::abs(largest[j]));
  });
  if (!done) return ends;
  ends.largest = t.eigenvalue(t.diagonal.size() - 1);
  ends.smallest = t.eigenvalue(0);
  const std::vector<double> top = t.eigenvector(ends.largest);
  const std::vector<double> bottom = t.eigenvector(ends.smallest);

  ends.top.assign(free.size(), {});
  ends.bottom.assign(free.size(), {});
  Tridiagonal again;
  ends.known = recurrence(apply, start, again, [&](std::size_t j, const Vector& q) {
    add(ends.top, top[j], q);
    add(ends.bottom, bottom[j], q);
    return j + 1 < top.size();
  });
  ends.products = static_cast<std::uint32_t>(2 * top.size());
  for (Vector* vector : {&ends.top, &ends.bottom}) {
    const double size = std::sqrt(product(*vector, *vector));
    if (size > 0) scale(*vector, 1 / size);
  }
  return ends;
}

double largest_eigenvalue(const SymmetricOperator& apply, std::span<const double> start,
                          std::uint32_t steps) {
  Vector first = start_vector(start);
  const double length = std::sqrt(product(first, first));
  if (length == 0) return 0;
  scale(first, 1 / length);
  Tridiagonal t;
  const bool done = recurrence(apply, first, t,
                               [&](std::size_t j, const Vector&) { return j + 1 < steps; });
  return done ? t.eigenvalue(t.diagonal.size() - 1) : 0;
}

double rayleigh_quotient(const SymmetricOperator& apply, std::span<const VertexRecord> vector) {
  Vector image(vector.size());
  if (!apply(vector, image)) return 0;
  double sum = 0;
  for (std::size_t r = 0; r < vector.size(); ++r) sum += dot(vector[r], image[r]);
  return sum;
}

}  // namespace gmsim::engine
