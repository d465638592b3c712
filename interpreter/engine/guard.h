// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "engine/integrators/phase_point.h"
#include "engine/state.h"

namespace gmsim::engine {

/// The edges of a map, and their lengths when this was made.
class EdgeLengths {
 public:
  EdgeLengths() = default;
  EdgeLengths(const State& state, const Motion& motion);

  /// m; 0 without edges.
  [[nodiscard]] double shortest() const { return shortest_; }
  /// Largest length over original length, of the edges that are still there; 1 without edges.
  [[nodiscard]] double max_elongation(const State& state, const Motion& motion) const;

 private:
  struct Edge {
    DartId dart = gmap::kNoDart;
    double length = 0;
  };
  std::vector<Edge> edges_;
  double shortest_ = 0;
};

/// Looks at every step before it counts, so that nothing that is no number leaves one.
class Guard {
 public:
  /// What one look found.
  struct Finding {
    bool finite = true;
    Row row = 0;            ///< of a vertex that is not finite, or of the fastest one
    double max_speed = 0;   ///< m/s, when finite
  };
  [[nodiscard]] static Finding look(const PhasePoint& point);
  /// Is everything a number at this row?
  [[nodiscard]] static bool finite(const PhasePoint& point, Row row);

  explicit Guard(double shortest_edge = 0) : shortest_edge_(shortest_edge) {}
  /// A vertex passes the shortest edge within a step. A fast body may do that; a model whose step is
  /// too long soon does, so it is time to look closer.
  [[nodiscard]] bool suspicious(const Finding& finding, double dt) const {
    return shortest_edge_ > 0 && finding.max_speed * dt > shortest_edge_;
  }

  /// J. Notes the energies of a sound state: that of moving freely, and the potential one against
  /// the first seen.
  void note_energy(double kinetic, double potential);
  /// This kinetic energy is more than a thousand times all energy seen so far.
  [[nodiscard]] bool outgrown(double kinetic) const {
    return energy_scale_ > 0 && kinetic > 1e3 * energy_scale_;
  }

 private:
  double shortest_edge_ = 0;  // m
  std::optional<double> first_potential_;
  double energy_scale_ = 0;
};

}  // namespace gmsim::engine
