// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/force_field.h"

namespace gmsim::engine {

/// Where the model is at one time, and the forces there: the first stage of the step that starts
/// here. One record per row of the vertex index.
struct PhasePoint {
  double time = 0;  ///< s
  Motion motion;
  std::vector<VertexRecord> force;  ///< N

  [[nodiscard]] std::size_t rows() const { return force.size(); }
  void resize(std::size_t rows) {
    motion.position.resize(rows);
    motion.velocity.resize(rows);
    force.resize(rows);
  }
};

}  // namespace gmsim::engine
