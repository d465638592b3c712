// SPDX-License-Identifier: MIT
#include "cli/write_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "engine/tree_eval.h"
#include "io/mesh_frame_from_map.h"
#include "io/obj_writer.h"
#include "io/vtu_writer.h"

namespace gmsim::cli {
namespace {

using types::EmbeddingId;

/// The value of one embedding at each of the darts; empty when one of them has none.
std::optional<io::DataArray> read_array(const engine::State& state, EmbeddingId id,
                                        const std::vector<gmap::DartId>& darts) {
  const gmap::EmbeddingDecl& declaration = state.store.schema()[id];
  engine::TreeEvaluator evaluator(state);
  io::DataArray array{declaration.name, types::component_count(declaration.type),
                      io::NumberType::Float64, {}};
  array.values.resize(darts.size() * array.components);
  for (std::size_t k = 0; k < darts.size(); ++k) {
    const std::span<double> row{array.values.data() + k * array.components, array.components};
    if (!evaluator.read(id, darts[k], row)) {
      (void)evaluator.take_failure();
      return std::nullopt;
    }
  }
  return array;
}

void add_fields(const engine::State& state, types::OrbitType orbit,
                const std::vector<gmap::DartId>& darts, std::vector<io::DataArray>& fields) {
  const gmap::EmbeddingSchema& schema = state.store.schema();
  for (std::uint32_t number = 0; number < schema.size(); ++number) {
    const EmbeddingId id{number};
    const gmap::EmbeddingDecl& declaration = schema[id];
    if (declaration.orbit != orbit || declaration.name == "position" ||
        declaration.role != gmap::EmbeddingRole::Data)
      continue;
    if (auto array = read_array(state, id, darts)) fields.push_back(std::move(*array));
  }
}

/// So that `--at` can name what a picture shows.
io::DataArray dart_numbers(const std::vector<gmap::DartId>& darts) {
  io::DataArray array{"dart", 1, io::NumberType::Int32, {}};
  for (const gmap::DartId dart : darts) array.values.push_back(types::index(dart));
  return array;
}

}  // namespace

void write_mesh(const engine::State& state, const io::PointNumbering& points,
                const std::filesystem::path& path, support::Diagnostics& diagnostics) {
  const std::string ending = path.extension().string();
  if (ending != ".vtu" && ending != ".obj") {
    diagnostics.report({.kind = support::DiagnosticKind::Usage,
                        .message = fmt::format("cannot write `{}`", path.string()),
                        .help = "results are written as .vtu or .obj"});
    return;
  }
  const int n = state.program.dimension;
  const types::OrbitType vertex = types::OrbitType::cell(0, n);
  const EmbeddingId position = *state.store.schema().find("position");
  io::MapFrame frame = io::mesh_frame_from_map(
      state.map, *state.store.find_index(vertex), points, [&](gmap::DartId dart) {
        const auto value = state.store.get(position, dart);
        return std::array<double, 3>{value[0], value[1], value[2]};
      });
  add_fields(state, vertex, frame.point_darts, frame.mesh.point_data);
  add_fields(state, types::OrbitType::cell(n, n), frame.cell_darts, frame.mesh.cell_data);
  frame.mesh.point_data.push_back(dart_numbers(frame.point_darts));
  frame.mesh.cell_data.push_back(dart_numbers(frame.cell_darts));
  if (ending == ".vtu") io::write_vtu(path, frame.mesh, diagnostics);
  else io::write_obj(path, frame.mesh, diagnostics);
}

}  // namespace gmsim::cli
