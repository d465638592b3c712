// SPDX-License-Identifier: MIT
// The jobs of bare_map.h through GMap, OrbitIndex and EmbeddingStore, as a rewriting engine does
// them: the rewrites first, then one repair. Vertex index, face index and positions are right after
// every job.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "bench/bare_map.h"
#include "gmap/embedding_store.h"
#include "gmap/mesh.h"

namespace gmsim::bench {

/// Buffers that an engine keeps from step to step.
struct Workspace {
  std::vector<gmap::DartId> touched;
  gmap::OrbitRepair vertices, faces;
  std::vector<gmap::DartId> face, middle, removed;
  std::vector<std::uint32_t> sources;  ///< number of vertices that were merged into a row
};

class MapJobs {
 public:
  /// Takes a built map and gives its vertices the positions of the points.
  MapJobs(gmap::MeshMap built, const std::vector<std::array<double, 3>>& points, Workspace& work);
  MapJobs(const MapJobs&) = delete;
  MapJobs& operator=(const MapJobs&) = delete;

  using Edges = std::vector<std::pair<gmap::DartId, gmap::DartId>>;

  [[nodiscard]] std::int64_t walk_vertices() const;
  Edges unsew_all();
  /// As bare_displace.
  void displace();
  void sew_all(const Edges& edges, Merge merge);
  void cone_all();
  void remove_every_second();

  [[nodiscard]] const gmap::GMap& map() const { return map_; }
  [[nodiscard]] const gmap::EmbeddingStore& store() const { return store_; }
  [[nodiscard]] types::EmbeddingId position() const { return position_; }
  [[nodiscard]] std::size_t memory_bytes() const {
    return map_.memory_bytes() + store_.memory_bytes();
  }

 private:
  /// Repairs the vertex index; parts of a split vertex get its position.
  void repair_vertices();
  void sew_dart(gmap::DartId d, gmap::DartId e, Merge merge);
  void add_position(gmap::Row kept, gmap::Row gone);
  void divide_positions();
  void repair_faces();
  void cone_face(gmap::DartId first_new);
  void name_cone(gmap::Row face_row, std::uint32_t first_new);
  [[nodiscard]] std::array<double, 3> face_middle() const;

  gmap::GMap map_;
  gmap::EmbeddingSchema schema_;
  types::EmbeddingId position_;
  gmap::EmbeddingStore store_;
  gmap::OrbitIndex& vertices_;
  gmap::OrbitIndex& faces_;
  gmap::EmbeddingColumn& positions_;
  Workspace& work_;
};

}  // namespace gmsim::bench
