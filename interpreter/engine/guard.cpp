// SPDX-License-Identifier: MIT
#include "engine/guard.h"

#include <algorithm>
#include <cmath>

#include "engine/integrators/vertex_record_math.h"

namespace gmsim::engine {
namespace {

bool finite(const VertexRecord& record) {
  return std::isfinite(record.x) && std::isfinite(record.y) && std::isfinite(record.z);
}

}  // namespace

EdgeLengths::EdgeLengths(const State& state, const Motion& motion) {
  const gmap::OrbitIndex& vertices =
      state.store.index_of(*state.program.schema.find("position"));
  for (std::uint32_t i = 0; i < state.map.dart_end(); ++i) {
    const DartId dart{i};
    if (!state.map.alive(dart)) continue;
    const DartId other = state.map.alpha(0, dart);
    const Row a = vertices.row(dart), b = vertices.row(other);
    if (a < b) edges_.push_back({dart, a, b, 0});
  }
  const auto key = [](const Edge& edge) { return std::pair(edge.a, edge.b); };
  std::ranges::sort(edges_, {}, key);
  edges_.erase(std::ranges::unique(edges_, {}, key).begin(), edges_.end());
  for (Edge& edge : edges_) {
    const VertexRecord along = motion.position[edge.b] - motion.position[edge.a];
    edge.length = std::sqrt(dot(along, along));
    if (edge.length > 0)
      shortest_ = shortest_ == 0 ? edge.length : std::min(shortest_, edge.length);
  }
}

void EdgeLengths::follow(const State& state) {
  const gmap::OrbitIndex& vertices =
      state.store.index_of(*state.program.schema.find("position"));
  std::erase_if(edges_, [&](const Edge& edge) { return !state.map.alive(edge.dart); });
  for (Edge& edge : edges_) {
    edge.a = vertices.row(edge.dart);
    edge.b = vertices.row(state.map.alpha(0, edge.dart));
  }
}

double EdgeLengths::max_elongation(const Motion& motion) const {
  double largest = edges_.empty() ? 1 : 0;
  for (const Edge& edge : edges_) {
    if (edge.length == 0) continue;
    const VertexRecord along = motion.position[edge.b] - motion.position[edge.a];
    largest = std::max(largest, std::sqrt(dot(along, along)) / edge.length);
  }
  return largest;
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
    if (!finite(point.motion.position[r]) || !finite(point.motion.velocity[r]) ||
        !finite(point.force[r]))
      break;
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
