// SPDX-License-Identifier: MIT
// The yardstick: a surface mesh as bare int32 arrays with the loops one would write by hand for
// each job, nothing general about them. Vertex numbers and positions are right after every job.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "gmap/mesh.h"

namespace gmsim::bench {

struct BareMap {
  std::vector<std::int32_t> alpha0, alpha1, alpha2;  // per dart; alpha0 < 0: dead
  std::vector<std::int32_t> vertex;                  // per dart
  std::vector<std::array<double, 3>> position;       // per vertex

  [[nodiscard]] std::int32_t dart_end() const { return static_cast<std::int32_t>(alpha0.size()); }
  [[nodiscard]] std::size_t memory_bytes() const;
};

/// Pairs of darts, one for each edge, that are sewn together.
using SewnEdges = std::vector<std::pair<std::int32_t, std::int32_t>>;

[[nodiscard]] BareMap bare_construct(const gmap::Mesh& mesh);
/// One dart for each vertex.
[[nodiscard]] std::vector<std::int32_t> bare_vertex_darts(const BareMap& map);
/// Walks every vertex and adds up the darts.
[[nodiscard]] std::int64_t bare_walk(const BareMap& map, const std::vector<std::int32_t>& starts);
/// Numbers the vertex orbits anew; returns how many there are.
std::int32_t bare_number_vertices(BareMap& map);
/// Unsews every inner edge, one after another; vertices are split as they fall apart.
SewnEdges bare_unsew_all(BareMap& map);
/// Moves every vertex by a distance that its smallest dart decides, so that a mean can go wrong.
void bare_displace(BareMap& map);
[[nodiscard]] inline double displacement(std::uint32_t smallest_dart) {
  return 1e-3 * (smallest_dart % 7);
}
/// What becomes of the positions when vertices are merged: the mean over all of them, as the
/// standard library declares for `position`, or that of the vertex that stays.
enum class Merge { Mean, KeepFirst };
/// Sews the edges one after another; the vertex of the first dart stays.
void bare_sew_all(BareMap& map, const SewnEdges& edges, Merge merge);
/// Replaces every face by the triangles between its edges and a new vertex in its middle.
void bare_cone_all(BareMap& map);
/// Removes faces 1, 3, 5, …, counted by their smallest darts.
void bare_remove_every_second(BareMap& map);

}  // namespace gmsim::bench
