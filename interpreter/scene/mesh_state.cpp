// SPDX-License-Identifier: MIT
#include "scene/mesh_state.h"

#include "gmap/cell_measure.h"
#include "gmap/orbit_index.h"
#include "support/check.h"

namespace gmsim::scene {
namespace {

using gmap::Row;

/// The standard library always declares these; a scene without them cannot be built.
types::EmbeddingId required(const engine::State& state, const char* name) {
  const auto id = state.store.schema().find(name);
  GMSIM_CHECK(id.has_value(), std::string("no embedding `") + name + "` in the schema");
  return *id;
}

}  // namespace

void set_positions(engine::State& state, const gmap::Mesh& mesh,
                   const std::vector<std::uint32_t>& dart_point) {
  const types::EmbeddingId position = required(state, "position");
  gmap::EmbeddingColumn& column = state.store.use(position);
  const gmap::OrbitIndex& vertices = state.store.use_index(state.store.schema()[position].orbit);
  for (Row row = 0; row < vertices.row_end(); ++row) {
    const std::uint32_t point = dart_point[types::index(vertices.smallest(row))];
    column.set(row, mesh.points[point]);
  }
}

void set_corner_masses(engine::State& state, const gmap::Mesh& mesh,
                       const std::vector<std::uint32_t>& dart_cell, double density) {
  const types::EmbeddingId corner_mass = required(state, "corner_mass");
  gmap::EmbeddingColumn& column = state.store.use(corner_mass);
  const gmap::OrbitIndex& corners = state.store.use_index(state.store.schema()[corner_mass].orbit);
  for (Row row = 0; row < corners.row_end(); ++row) {
    const std::uint32_t cell = dart_cell[types::index(corners.smallest(row))];
    const std::uint32_t count = mesh.cell_begin[cell + 1] - mesh.cell_begin[cell];
    const double share = density * gmap::cell_measure(mesh, cell) / count;
    column.set(row, {&share, 1});
  }
}

std::vector<std::string> missing_embeddings(const engine::State& state) {
  std::vector<std::string> missing;
  for (const types::EmbeddingId id : state.store.embeddings()) {
    const gmap::EmbeddingDecl& declaration = state.store.schema()[id];
    if (declaration.optional) continue;
    const gmap::OrbitIndex* rows = state.store.find_index(declaration.orbit);
    for (Row row = 0; row < rows->row_end(); ++row) {
      if (!rows->alive(row) || state.store.column(id).has(row)) continue;
      missing.push_back(declaration.name);
      break;
    }
  }
  return missing;
}

}  // namespace gmsim::scene
