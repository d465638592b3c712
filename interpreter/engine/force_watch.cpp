// SPDX-License-Identifier: MIT
#include "engine/force_watch.h"

#include <algorithm>

namespace gmsim::engine {

void VertexWatch::clear() { *this = VertexWatch(); }

void VertexWatch::add(gmap::Row vertex, gmap::DartId key) {
  if (!packed_) {
    unpacked_.emplace_back(vertex, key);
    return;
  }
  std::vector<gmap::DartId>& list = more_[vertex];
  if (std::find(list.begin(), list.end(), key) == list.end()) list.push_back(key);
}

void VertexWatch::pack() {
  packed_ = true;
  gmap::Row vertices = 0;
  for (const auto& [vertex, key] : unpacked_) vertices = std::max(vertices, vertex + 1);
  begin_.assign(vertices + std::size_t{1}, 0);
  for (const auto& [vertex, key] : unpacked_) ++begin_[vertex + 1];
  for (gmap::Row vertex = 0; vertex < vertices; ++vertex) begin_[vertex + 1] += begin_[vertex];
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  keys_.resize(unpacked_.size());
  for (const auto& [vertex, key] : unpacked_) keys_[next[vertex]++] = key;
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
