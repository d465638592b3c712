// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "gmap/embedding_schema.h"
#include "support/tiny_map.h"
#include "types/expr.h"

/// Evaluates checked expressions on a TinyMap straight from their definition, for oracles: numbers,
/// vectors, darts, orbits and folds. Values of embeddings are random, one for each orbit.
namespace gmsim::tests {

class TinyEval {
 public:
  using Vector = std::array<double, 3>;

  TinyEval(const TinyMap& map, const gmap::EmbeddingSchema& schema, Random& random);

  void set(types::Slot slot, int dart) { locals_[types::index(slot)] = dart; }
  /// Empty when the value does not exist: a polygon of an open face.
  [[nodiscard]] std::optional<Vector> evaluate(const types::Expr& expr);

 private:
  struct OpenFace {};
  Vector value(const types::Expr& expr);
  int dart(const types::Expr& expr);
  std::vector<int> darts(const types::Expr& expr);
  std::vector<int> polygon(int from);
  Vector fold(const types::Expr& expr);
  Vector call(const types::Expr& expr);

  const TinyMap& map_;
  const gmap::EmbeddingSchema& schema_;
  std::map<std::uint8_t, std::vector<int>> orbits_;  // by orbit type: dart -> orbit
  std::vector<std::vector<Vector>> values_;          // by embedding, by orbit
  std::map<std::uint32_t, int> locals_;
};

}  // namespace gmsim::tests
