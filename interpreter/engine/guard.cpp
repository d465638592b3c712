// SPDX-License-Identifier: MIT
#include "engine/guard.h"

#include <algorithm>
#include <cmath>

#include "engine/integrators/vertex_record_math.h"

namespace gmsim::engine {
namespace {

bool is_finite(const VertexRecord& record) {
  return std::isfinite(record.x) && std::isfinite(record.y) && std::isfinite(record.z);
}

}  // namespace

namespace {

double length_of(const State& state, const Motion& motion, DartId edge) {
  const gmap::OrbitIndex& vertices =
      state.store.index_of(*state.program.schema.find("position"));
  const VertexRecord along = motion.position[vertices.row(state.map.alpha(0, edge))] -
                             motion.position[vertices.row(edge)];
  return std::sqrt(dot(along, along));
}

}  // namespace

EdgeLengths::EdgeLengths(const State& state, const Motion& motion) {
  const gmap::OrbitIndex& vertices =
      state.store.index_of(*state.program.schema.find("position"));
  struct Between {
    Row a = 0, b = 0;
    DartId dart = gmap::kNoDart;
  };
  std::vector<Between> edges;
  for (std::uint32_t i = 0; i < state.map.dart_end(); ++i) {
    const DartId dart{i};
    if (!state.map.alive(dart)) continue;
    const Row a = vertices.row(dart), b = vertices.row(state.map.alpha(0, dart));
    if (a < b) edges.push_back({a, b, dart});
  }
  const auto ends = [](const Between& edge) { return std::pair(edge.a, edge.b); };
  std::ranges::sort(edges, {}, ends);
  edges.erase(std::ranges::unique(edges, {}, ends).begin(), edges.end());
  for (const Between& edge : edges) {
    const double length = length_of(state, motion, edge.dart);
    edges_.push_back({edge.dart, length});
    if (length > 0) shortest_ = shortest_ == 0 ? length : std::min(shortest_, length);
  }
}

double EdgeLengths::max_elongation(const State& state, const Motion& motion) const {
  double largest = -1;
  for (const Edge& edge : edges_) {
    if (!state.map.alive(edge.dart)) continue;
    largest = std::max(largest, 0.0);
    if (edge.length > 0)
      largest = std::max(largest, length_of(state, motion, edge.dart) / edge.length);
  }
  return largest < 0 ? 1 : largest;
}

bool Guard::finite(const PhasePoint& point, Row row) {
  return is_finite(point.motion.position[row]) && is_finite(point.motion.velocity[row]) &&
         is_finite(point.force[row]);
}

Guard::Finding Guard::look(const PhasePoint& point) {
  // x - x is 0 for a number and nothing else for what is none.
  VertexRecord sum;
  double max_square = 0;
  Row fastest = 0;
  for (std::size_t r = 0; r < point.rows(); ++r) {
    const VertexRecord& x = point.motion.position[r];
    const VertexRecord& v = point.motion.velocity[r];
    const VertexRecord& f = point.force[r];
    sum = sum + (x - x) + (v - v) + (f - f);
    const double square = dot(v, v);
    if (square > max_square) {
      max_square = square;
      fastest = static_cast<Row>(r);
    }
  }
  Finding finding{.row = fastest, .max_speed = std::sqrt(max_square)};
  if (sum.x + sum.y + sum.z == 0 && std::isfinite(max_square)) return finding;
  finding.finite = false;
  for (std::size_t r = 0; r < point.rows(); ++r) {
    finding.row = static_cast<Row>(r);
    if (!finite(point, static_cast<Row>(r))) break;
    const double square = dot(point.motion.velocity[r], point.motion.velocity[r]);
    if (!std::isfinite(square)) break;
  }
  return finding;
}

void Guard::note_energy(double kinetic, double potential) {
  if (!first_potential_) first_potential_ = potential;
  energy_scale_ =
      std::max({energy_scale_, kinetic, std::abs(potential - *first_potential_)});
}

}  // namespace gmsim::engine
