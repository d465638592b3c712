// SPDX-License-Identifier: MIT
#include "engine/force_watch.h"

#include <algorithm>

namespace gmsim::engine {

void DartWatch::clear() { *this = DartWatch(); }

void DartWatch::add(gmap::DartId dart, gmap::DartId key) {
  if (!packed_) {
    unpacked_.emplace_back(dart, key);
    return;
  }
  const std::size_t d = types::index(dart);
  if (d + 1 < begin_.size())
    for (std::uint32_t k = begin_[d]; k < begin_[d + 1]; ++k)
      if (keys_[k] == key) return;
  std::vector<gmap::DartId>& list = more_[dart];
  if (std::find(list.begin(), list.end(), key) == list.end()) list.push_back(key);
}

void DartWatch::pack() {
  packed_ = true;
  std::size_t darts = 0;
  for (const auto& [dart, key] : unpacked_) darts = std::max(darts, types::index(dart) + std::size_t{1});
  begin_.assign(darts + 1, 0);
  for (const auto& [dart, key] : unpacked_) ++begin_[types::index(dart) + std::size_t{1}];
  for (std::size_t d = 0; d < darts; ++d) begin_[d + 1] += begin_[d];
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  keys_.resize(unpacked_.size());
  for (const auto& [dart, key] : unpacked_) keys_[next[types::index(dart)]++] = key;
  unpacked_ = {};
}

namespace {

using types::Expr;
using types::ExprKind;

bool stays(const gmap::EmbeddingSchema& schema, const Expr& expr, types::OrbitType within) {
  switch (expr.kind) {
    case ExprKind::Alpha: case ExprKind::Free: case ExprKind::Has: case ExprKind::Polygon:
    case ExprKind::AllOrbits: case ExprKind::Forces: case ExprKind::ForceOn:
      return false;
    case ExprKind::Random: case ExprKind::OrbitDarts: case ExprKind::Quotient:
      if (!within.contains(expr.orbit)) return false;
      break;
    case ExprKind::Embedding: {
      const gmap::EmbeddingDecl& decl = schema[expr.embedding];
      if (!within.contains(decl.orbit)) return false;
      if (decl.derivation && !stays(schema, *decl.derivation, within)) return false;
      break;
    }
    default:
      break;
  }
  return std::all_of(expr.args.begin(), expr.args.end(), [&](const types::ExprPtr& argument) {
    return argument == nullptr || stays(schema, *argument, within);
  });
}

}  // namespace

bool stays_in_orbit(const gmap::EmbeddingSchema& schema, types::EmbeddingId derived) {
  const gmap::EmbeddingDecl& decl = schema[derived];
  return decl.derivation == nullptr || stays(schema, *decl.derivation, decl.orbit);
}

}  // namespace gmsim::engine
