// SPDX-License-Identifier: MIT
#include "engine/force_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "gmap/orbit_walk.h"
#include "support/sort_once.h"

namespace gmsim::engine {

namespace {

constexpr std::uint32_t kNoPiece = 0xffffffffu;
constexpr double kSame = 1e-9;  // eigenvalues that differ by less, relatively, are one

/// Are all eigenvalues of a symmetric matrix below `bound`? By a Cholesky factorisation of
/// bound I - matrix.
bool eigenvalues_below(const std::vector<double>& matrix, std::size_t n, double bound) {
  std::vector<double> l(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = (i == j ? bound : 0.0) - matrix[i * n + j];
      for (std::size_t k = 0; k < j; ++k) sum -= l[i * n + k] * l[j * n + k];
      if (i == j && !(sum > 0)) return false;
      l[i * n + j] = i == j ? std::sqrt(sum) : sum / l[j * n + j];
    }
  }
  return true;
}

}  // namespace

ElementBounds::ElementBounds(const ForceContext& context)
    : context_(context),
      corner_mass_(context.state.program.schema.find("corner_mass")),
      fixed_(context.state.program.schema.find("fixed")),
      corner_(OrbitType::range(1, context.state.map.dimension() - 1)),
      element_(OrbitType::range(0, context.state.map.dimension() - 1)),
      of_element_(context.state.map.dart_end(), kNoPiece) {}

double ElementBounds::mass(DartId corner) const {
  const gmap::EmbeddingStore& store = context_.state.store;
  if (!corner_mass_ || !store.in_use(*corner_mass_)) return 0;
  const std::span<const double> value = store.get(*corner_mass_, corner);
  return value.empty() ? 0 : value[0];
}

ElementBounds::Stand ElementBounds::stand(const compile::Shape& shape,
                                          std::span<const DartId> targets) const {
  const gmap::GMap& map = context_.state.map;
  const gmap::EmbeddingStore& store = context_.state.store;
  Stand result;
  result.corners.resize(shape.forces.size());
  for (std::size_t k = 0; k < shape.targets.size(); ++k) {
    const compile::ForceTarget& target = shape.targets[k];
    const DartId dart = targets[k];
    if (fixed_ && store.in_use(*fixed_) && store.get(*fixed_, dart)[0] != 0) continue;
    auto& corners = result.corners[target.root];
    if (corner_.contains(target.orbit)) {
      corners.push_back(gmap::smallest_dart(map, corner_, dart));
    } else {
      for (const DartId d : gmap::quotient(map, target.orbit, corner_, dart))
        corners.push_back(gmap::smallest_dart(map, corner_, d));
    }
  }
  bool one_element = true;
  for (auto& corners : result.corners) {
    support::sort_once(corners);
    one_element = one_element && corners.size() <= 1;
    for (const DartId corner : corners) {
      const DartId element = gmap::smallest_dart(map, element_, corner);
      one_element = one_element && (result.element == gmap::kNoDart || result.element == element);
      result.element = element;
    }
  }
  if (!one_element) result.element = gmap::kNoDart;
  return result;
}

std::size_t ElementBounds::place(Piece& piece, const std::vector<DartId>& corners) {
  const auto known = std::find(piece.places.begin(), piece.places.end(), corners);
  const auto number = static_cast<std::size_t>(known - piece.places.begin());
  if (known != piece.places.end()) return number;
  const std::size_t before = 3 * piece.places.size(), after = before + 3;
  std::vector<double> larger(after * after, 0.0);
  for (std::size_t i = 0; i < before; ++i)
    for (std::size_t j = 0; j < before; ++j) larger[i * after + j] = piece.matrix[i * before + j];
  piece.matrix = std::move(larger);
  piece.places.push_back(corners);
  return number;
}

void ElementBounds::add(std::uint32_t interaction, DartId where, const Stand& stand,
                        std::span<const double> matrix) {
  const double size = std::sqrt(std::inner_product(matrix.begin(), matrix.end(), matrix.begin(), 0.0));
  if (size == 0) return;
  std::size_t number = pieces_.size();
  if (stand.element != gmap::kNoDart) {
    std::uint32_t& piece = of_element_[types::index(stand.element)];
    if (piece == kNoPiece) piece = static_cast<std::uint32_t>(number);
    number = piece;
  }
  if (number == pieces_.size()) pieces_.emplace_back();
  Piece& piece = pieces_[number];
  if (size > piece.stiffest) {
    piece.stiffest = size;
    piece.where = where;
    piece.interaction = interaction;
  }
  std::vector<std::size_t> places;
  for (const auto& corners : stand.corners)
    places.push_back(corners.empty() ? piece.places.size() : place(piece, corners));
  const std::size_t columns = 3 * stand.corners.size(), n = 3 * piece.places.size();
  for (std::size_t i = 0; i < columns; ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      if (stand.corners[i / 3].empty() || stand.corners[j / 3].empty()) continue;
      const double symmetric = 0.5 * (matrix[i * columns + j] + matrix[j * columns + i]);
      piece.matrix[(3 * places[i / 3] + i % 3) * n + 3 * places[j / 3] + j % 3] += symmetric;
    }
  }
}

double ElementBounds::weight(const Piece& piece, std::size_t place) {
  const std::size_t n = 3 * piece.places.size();
  const auto begin = piece.matrix.begin() + static_cast<std::ptrdiff_t>(3 * place * n);
  return std::sqrt(std::inner_product(begin, begin + static_cast<std::ptrdiff_t>(3 * n), begin, 0.0));
}

std::vector<double> ElementBounds::total_weights() const {
  std::vector<double> totals(context_.state.map.dart_end(), 0.0);
  for (const Piece& piece : pieces_)
    for (std::size_t p = 0; p < piece.places.size(); ++p)
      for (const DartId corner : piece.places[p]) totals[types::index(corner)] += weight(piece, p);
  return totals;
}

double ElementBounds::eigenvalue(const Piece& piece,
                                 const std::vector<double>& totals, double known) const {
  const std::size_t places = piece.places.size();
  std::vector<double> scale(places, 0.0);  // 1 / sqrt(mass)
  for (std::size_t p = 0; p < places; ++p) {
    const double own = weight(piece, p);
    if (own == 0) continue;
    double share = 0;
    for (const DartId corner : piece.places[p])
      share += mass(corner) * own / totals[types::index(corner)];
    if (share <= 0) return std::numeric_limits<double>::infinity();
    scale[p] = 1 / std::sqrt(share);
  }
  const std::size_t n = 3 * places;
  std::vector<double> scaled(piece.matrix);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) scaled[i * n + j] *= scale[i / 3] * scale[j / 3];
  // Most pieces of a mesh are much alike: a factorisation shows at a fraction of the cost that a piece
  // is not stiffer than the stiffest so far.
  if (eigenvalues_below(scaled, n, known * (1 + kSame))) return known;
  return largest_eigenvalue(std::move(scaled), n);
}

ElementBounds::Largest ElementBounds::largest() const {
  const std::vector<double> totals = total_weights();
  Largest result;
  for (const Piece& piece : pieces_) {
    const double value = eigenvalue(piece, totals, result.value);
    if (value > result.value) result = {value, piece.where, context_.active[piece.interaction].interaction};
  }
  return result;
}

namespace {

/// One rotation that makes entry (p, q) zero.
void rotate(std::vector<double>& a, std::size_t n, std::size_t p, std::size_t q) {
  const double theta = (a[q * n + q] - a[p * n + p]) / (2 * a[p * n + q]);
  const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::hypot(theta, 1.0));
  const double c = 1 / std::hypot(t, 1.0), s = t * c;
  for (std::size_t k = 0; k < n; ++k) {
    const double x = a[k * n + p], y = a[k * n + q];
    a[k * n + p] = c * x - s * y;
    a[k * n + q] = s * x + c * y;
  }
  for (std::size_t k = 0; k < n; ++k) {
    const double x = a[p * n + k], y = a[q * n + k];
    a[p * n + k] = c * x - s * y;
    a[q * n + k] = s * x + c * y;
  }
}

}  // namespace

double largest_eigenvalue(std::vector<double> matrix, std::size_t n) {
  constexpr int kMostSweeps = 30;
  constexpr double kRelative = 1e-14;
  double norm = 0;
  for (const double entry : matrix) norm = std::max(norm, std::abs(entry));
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    double off = 0;
    for (std::size_t p = 0; p < n; ++p) {
      for (std::size_t q = p + 1; q < n; ++q) {
        off = std::max(off, std::abs(matrix[p * n + q]));
        if (std::abs(matrix[p * n + q]) > kRelative * norm) rotate(matrix, n, p, q);
      }
    }
    if (off <= kRelative * norm) break;
  }
  double largest = n == 0 ? 0 : matrix[0];
  for (std::size_t i = 1; i < n; ++i) largest = std::max(largest, matrix[i * n + i]);
  return largest;
}

}  // namespace gmsim::engine
