// SPDX-License-Identifier: MIT
#include "io/view_frames.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "support/check.h"

namespace gmsim::io {

namespace {

using support::Diagnostics;

/// A number, or the length of several: sqrt(sum of their squares).
double shown_value(const DataArray& array, std::uint32_t row) {
  const double* first = array.values.data() + std::size_t{row} * array.components;
  if (array.components == 1) return *first;
  double length = 0;
  for (std::uint32_t i = 0; i < array.components; ++i) length = std::hypot(length, first[i]);
  return length;
}

const DataArray& find_array(const MeshFrame& frame, const FieldDescription& field) {
  const auto& arrays = field.place == FieldPlace::Point ? frame.point_data : frame.cell_data;
  const auto found = std::find_if(arrays.begin(), arrays.end(), [&](const DataArray& array) {
    return array.name == field.name;
  });
  GMSIM_CHECK(found != arrays.end(), "a frame lacks a field of its description");
  return *found;
}

const std::vector<std::uint32_t>& rows_of(const ViewMesh& mesh, const FieldDescription& field) {
  return field.place == FieldPlace::Point ? mesh.points : mesh.cells;
}

void extend(ViewScale& scale, const MeshFrame& frame, const RunDescription& run) {
  const ViewMesh& mesh = scale.meshes.back();
  for (const std::uint32_t point : mesh.points)
    for (std::size_t axis = 0; axis < 3; ++axis) scale.box[axis].add(frame.points[point][axis]);
  for (std::size_t i = 0; i < scale.fields.size(); ++i) {
    const FieldDescription& field = run.fields[scale.fields[i]];
    const DataArray& array = find_array(frame, field);
    for (const std::uint32_t row : rows_of(mesh, field)) scale.ranges[i].add(shown_value(array, row));
  }
}

std::vector<std::uint16_t> positions_of(const ViewScale& scale, const ViewMesh& mesh,
                                        const MeshFrame& frame) {
  std::vector<std::uint16_t> positions;
  positions.reserve(3 * mesh.points.size());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Quantiser quantise = scale.box[axis].quantiser(kPositionSteps);
    for (const std::uint32_t point : mesh.points)
      positions.push_back(static_cast<std::uint16_t>(quantise(frame.points[point][axis])));
  }
  return positions;
}

std::vector<std::uint8_t> values_of(const ViewScale& scale, std::size_t number,
                                    const FieldDescription& field, const ViewMesh& mesh,
                                    const MeshFrame& frame) {
  const Quantiser quantise = scale.ranges[number].quantiser(kValueSteps);
  const DataArray& array = find_array(frame, field);
  std::vector<std::uint8_t> values;
  for (const std::uint32_t row : rows_of(mesh, field))
    values.push_back(static_cast<std::uint8_t>(quantise(shown_value(array, row))));
  return values;
}

/// What the frame before left, to compare with.
struct Before {
  std::optional<std::size_t> mesh;
  std::vector<std::uint16_t> positions;
  std::vector<std::vector<std::uint8_t>> values;
  ViewFrame at;
};

ViewFrame add_frame(const RunDescription& run, const ViewScale& scale, std::size_t number,
                    const MeshFrame& frame, Before& before, ViewBlock& block) {
  const ViewMesh& mesh = scale.meshes[scale.mesh_of[number]];
  const bool same_mesh = before.mesh == scale.mesh_of[number];
  std::vector<std::uint16_t> positions = positions_of(scale, mesh, frame);
  std::vector<std::uint16_t> stored = positions;
  if (same_mesh)
    for (std::size_t i = 0; i < stored.size(); ++i)
      stored[i] = static_cast<std::uint16_t>(stored[i] - before.positions[i]);
  ViewFrame at{.positions = block.add_steps(stored), .fields = {}};
  for (std::size_t i = 0; i < scale.fields.size(); ++i) {
    auto values = values_of(scale, i, run.fields[scale.fields[i]], mesh, frame);
    const bool unchanged = same_mesh && values == before.values[i];
    at.fields.push_back(unchanged ? before.at.fields[i] : block.add_values(values));
    before.values[i] = std::move(values);
  }
  before.mesh = scale.mesh_of[number];
  before.positions = std::move(positions);
  before.at = at;
  return at;
}

}  // namespace

std::vector<std::int64_t> even_frames(std::int64_t count, std::int64_t limit) {
  const std::int64_t wanted = std::min(count, limit);
  if (wanted == 1) return {count - 1};
  std::vector<std::int64_t> frames;
  for (std::int64_t i = 0; i < wanted; ++i)
    frames.push_back((2 * i * (count - 1) + wanted - 1) / (2 * (wanted - 1)));
  return frames;
}

std::optional<ViewScale> view_scale(const TrajectoryReader& reader,
                                    std::vector<std::int64_t> frames, Diagnostics& diagnostics) {
  ViewScale scale;
  const auto& fields = reader.run().fields;
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (fields[i].place == FieldPlace::Point || fields[i].place == FieldPlace::Cell)
      scale.fields.push_back(i);
  scale.ranges.resize(scale.fields.size());
  std::optional<std::int64_t> epoch;
  for (const std::int64_t number : frames) {
    const auto frame = reader.read_frame(number, true, diagnostics);
    if (!frame) return std::nullopt;
    const std::int64_t now = reader.epoch_of()[static_cast<std::size_t>(number)];
    if (std::exchange(epoch, now) != now)
      scale.meshes.push_back(view_mesh(frame->topology, frame->points));
    scale.mesh_of.push_back(scale.meshes.size() - 1);
    extend(scale, *frame, reader.run());
  }
  scale.frames = std::move(frames);
  return scale;
}

std::optional<std::vector<ViewFrame>> add_frames(const TrajectoryReader& reader,
                                                 const ViewScale& scale, ViewBlock& block,
                                                 Diagnostics& diagnostics) {
  std::vector<ViewFrame> places;
  Before before;
  before.values.resize(scale.fields.size());
  for (std::size_t i = 0; i < scale.frames.size(); ++i) {
    const auto frame = reader.read_frame(scale.frames[i], true, diagnostics);
    if (!frame) return std::nullopt;
    places.push_back(add_frame(reader.run(), scale, i, *frame, before, block));
  }
  return places;
}

}  // namespace gmsim::io
