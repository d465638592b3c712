// SPDX-License-Identifier: MIT
#include "engine/force_watch.h"

#include <algorithm>

namespace gmsim::engine {

void DartWatch::clear() { *this = DartWatch(); }

void DartWatch::add(gmap::DartId dart, const Entry& entry) {
  if (!packed_) {
    unpacked_.emplace_back(dart, entry);
    return;
  }
  const std::size_t d = types::index(dart);
  lists_.grow(d + 1);
  for (Entry& there : lists_.entries(d)) {
    if (there.key != entry.key) continue;
    there.what |= entry.what;
    return;
  }
  lists_.append(d, entry);
}

void DartWatch::pack() {
  packed_ = true;
  std::size_t darts = 0;
  for (const auto& [dart, entry] : unpacked_)
    darts = std::max(darts, types::index(dart) + std::size_t{1});
  std::vector<std::uint32_t> counts(darts, 0);
  for (const auto& [dart, entry] : unpacked_) ++counts[types::index(dart)];
  lists_.rebuild(darts, [&](std::size_t dart) { return counts[dart]; });
  for (const auto& [dart, entry] : unpacked_) lists_.append(types::index(dart), entry);
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
