// SPDX-License-Identifier: MIT
#include "support/tiny_eval.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "support/reference_rewriter.h"

namespace gmsim::tests {

using types::Expr;
using types::ExprKind;
using types::FoldKind;
using Vector = TinyEval::Vector;

namespace {

Vector scalar(double x) {
  return {x, 0, 0};
}
double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector combine(const Vector& a, double factor, const Vector& b) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

}  // namespace

TinyEval::TinyEval(const TinyMap& map, const gmap::EmbeddingSchema& schema, Random& random)
    : map_(map), schema_(schema) {
  for (std::uint8_t bits = 0; bits < 16; ++bits)
    orbits_[bits] = reference_orbits(map, types::OrbitType::from_bits(bits));
  const auto number = [&] { return 0.5 + 0.01 * below(random, 300); };
  for (const gmap::EmbeddingDecl& embedding : schema) {
    const bool vector = embedding.type.kind == types::ValueKind::Vec3;
    values_.emplace_back();
    for (int d = 0; d < map.size(); ++d)
      values_.back().push_back(vector ? Vector{number(), number(), number()} : scalar(number()));
  }
}

std::optional<Vector> TinyEval::evaluate(const Expr& expr) {
  try {
    return value(expr);
  } catch (const OpenFace&) {
    return std::nullopt;
  }
}

int TinyEval::dart(const Expr& expr) {
  if (expr.kind == ExprKind::Local) return locals_.at(types::index(expr.slot));
  if (expr.kind == ExprKind::Alpha)
    return map_.links[static_cast<std::size_t>(dart(*expr.args[0]))]
                     [static_cast<std::size_t>(expr.number)];
  throw std::invalid_argument("not a dart");
}

std::vector<int> TinyEval::polygon(int from) {
  std::vector<int> corners;
  int at = from;
  do {
    const int end = map_.links[static_cast<std::size_t>(at)][0];
    if (end == at || map_.links[static_cast<std::size_t>(end)][1] == end) throw OpenFace{};
    corners.push_back(at);
    at = map_.links[static_cast<std::size_t>(end)][1];
  } while (at != from);
  return corners;
}

std::vector<int> TinyEval::darts(const Expr& expr) {
  const int from = dart(*expr.args[0]);
  if (expr.kind == ExprKind::Polygon) return polygon(from);
  const std::vector<int>& orbit = orbits_.at(expr.orbit.bits());
  std::vector<int> found, seen;
  for (int d = 0; d < map_.size(); ++d) {
    if (orbit[static_cast<std::size_t>(d)] != orbit[static_cast<std::size_t>(from)]) continue;
    if (expr.kind == ExprKind::Quotient) {
      const int inner = orbits_.at(expr.orbit2.bits())[static_cast<std::size_t>(d)];
      if (std::count(seen.begin(), seen.end(), inner) > 0) continue;
      seen.push_back(inner);
    }
    found.push_back(d);
  }
  return found;
}

Vector TinyEval::fold(const Expr& expr) {
  const std::vector<int> over = darts(*expr.args[0]);
  if (expr.fold == FoldKind::Count) return scalar(static_cast<double>(over.size()));
  Vector total{};
  for (std::size_t k = 0; k < over.size(); ++k) {
    set(expr.slot, over[k]);
    const Vector x = value(*expr.args[1]);
    if (expr.fold == FoldKind::Min || expr.fold == FoldKind::Max) {
      const bool less = expr.fold == FoldKind::Min ? x[0] < total[0] : x[0] > total[0];
      if (k == 0 || less) total = x;
    } else {
      total = combine(total, 1.0, x);
    }
  }
  if (expr.fold != FoldKind::Mean) return total;
  return combine({}, 1.0 / static_cast<double>(over.size()), total);
}

Vector TinyEval::call(const Expr& expr) {
  const Vector a = value(*expr.args[0]);
  const Vector b = expr.args.size() > 1 ? value(*expr.args[1]) : Vector{};
  switch (expr.builtin) {
    case types::Builtin::Norm:
    case types::Builtin::Abs:
      return scalar(std::sqrt(dot(a, a)));
    case types::Builtin::Normalize:
      return dot(a, a) == 0 ? a : combine({}, 1.0 / std::sqrt(dot(a, a)), a);
    case types::Builtin::Dot:
      return scalar(dot(a, b));
    case types::Builtin::Cross:
      return cross(a, b);
    case types::Builtin::Min:
      return scalar(std::min(a[0], b[0]));
    case types::Builtin::Max:
      return scalar(std::max(a[0], b[0]));
    case types::Builtin::Sin:
      return scalar(std::sin(a[0]));
    case types::Builtin::Atan2:
      return scalar(std::atan2(a[0], b[0]));
    default:
      throw std::invalid_argument("a builtin without a value here");
  }
}

Vector TinyEval::value(const Expr& expr) {
  const auto arg = [&](std::size_t k) { return value(*expr.args[k]); };
  switch (expr.kind) {
    case ExprKind::Literal:
      return scalar(expr.value.as_real());
    case ExprKind::Embedding: {
      const std::uint32_t id = types::index(expr.embedding);
      const std::vector<int>& orbit = orbits_.at(schema_[expr.embedding].orbit.bits());
      const int at = orbit[static_cast<std::size_t>(dart(*expr.args[0]))];
      return values_[id][static_cast<std::size_t>(at)];
    }
    case ExprKind::Free:
      return scalar(map_.links[static_cast<std::size_t>(dart(*expr.args[0]))]
                              [static_cast<std::size_t>(expr.number)] == dart(*expr.args[0]));
    case ExprKind::Fold:
      return fold(expr);
    case ExprKind::Neg:
      return combine({}, -1.0, arg(0));
    case ExprKind::Add:
      return combine(arg(0), 1.0, arg(1));
    case ExprKind::Sub:
      return combine(arg(0), -1.0, arg(1));
    case ExprKind::Mul:
      return combine({}, arg(0)[0], arg(1));
    case ExprKind::Div:
      return combine({}, 1.0 / arg(1)[0], arg(0));
    case ExprKind::Pow:
      return scalar(std::pow(arg(0)[0], arg(1)[0]));
    case ExprKind::Less:
      return scalar(arg(0)[0] < arg(1)[0]);
    case ExprKind::Equal:
      return scalar(arg(0)[0] == arg(1)[0]);
    case ExprKind::If:
      return arg(0)[0] != 0 ? arg(1) : arg(2);
    case ExprKind::Component:
      return scalar(arg(0)[static_cast<std::size_t>(expr.number)]);
    case ExprKind::Call:
      return call(expr);
    default:
      throw std::invalid_argument("an expression without a value here");
  }
}

}  // namespace gmsim::tests
