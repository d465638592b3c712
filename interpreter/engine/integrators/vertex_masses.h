// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/state.h"
#include "engine/tree_eval.h"
#include "support/diagnostic.h"

namespace gmsim::engine {

/// Masses of vertices, read from the embedding `mass`, and their inverses.
class VertexMasses {
 public:
  explicit VertexMasses(const State& state) : state_(state), evaluator_(state) {}

  /// Weighs all vertices. False after a failure, which is then in `problem`: a free vertex without a
  /// usable mass. `held`, by row: fixed or prescribed.
  bool weigh_all(const std::vector<bool>& held, std::optional<support::Diagnostic>& problem);
  /// Weighs those among which something changed; rows that are gone, too.
  bool weigh(std::span<const Row> rows, const std::vector<bool>& held,
             std::optional<support::Diagnostic>& problem);
  /// Does a change of the map concern the masses of its own vertices alone?
  [[nodiscard]] bool local() const;

  /// kg by row of the vertex index; 0 for dead rows.
  [[nodiscard]] const std::vector<double>& masses() const { return masses_; }
  /// 1/kg by row; 0 for dead rows and held vertices.
  [[nodiscard]] const std::vector<double>& inverse() const { return inverse_; }

 private:
  bool weigh(Row row, bool held, std::optional<support::Diagnostic>& problem);

  const State& state_;
  TreeEvaluator evaluator_;
  std::vector<double> masses_, inverse_;
};

/// "vertex (0.1, 0.2, 0), dart 12", with the position that the store has.
[[nodiscard]] std::string vertex_text(const State& state, DartId dart);

}  // namespace gmsim::engine
