// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/trajectory_reader.h"
#include "io/view_block.h"
#include "io/view_mesh.h"
#include "support/diagnostic.h"

namespace gmsim::io {

/// At most `limit` of the frames 0 … count - 1, evenly spaced, with the first and the last; the
/// last alone when only one is wanted.
[[nodiscard]] std::vector<std::int64_t> even_frames(std::int64_t count, std::int64_t limit);

/// What the frames of a page have between them: their meshes, and the ranges that positions and
/// values are stored in. Only what is drawn counts.
struct ViewScale {
  std::vector<std::int64_t> frames;   ///< numbers in the file
  std::vector<std::size_t> mesh_of;   ///< of each frame, a position in meshes
  std::vector<ViewMesh> meshes;
  std::array<ValueRange, 3> box;      ///< m
  std::vector<std::size_t> fields;    ///< on points and cells, as positions in run().fields
  std::vector<ValueRange> ranges;     ///< of each of these fields
};
/// Reads the frames once. Nothing after an error, which is reported.
[[nodiscard]] std::optional<ViewScale> view_scale(const TrajectoryReader& reader,
                                                  std::vector<std::int64_t> frames,
                                                  support::Diagnostics& diagnostics);

/// Where a frame stands in the block.
struct ViewFrame {
  std::size_t positions = 0;        ///< steps: x of all points, then y, then z
  std::vector<std::size_t> fields;  ///< values: one for each point or cell
};
/// Reads the frames again and appends them. Positions are the difference, modulo 65536, to the
/// frame before where that has the same mesh. Values that did not change are not
/// stored again.
[[nodiscard]] std::optional<std::vector<ViewFrame>> add_frames(const TrajectoryReader& reader,
                                                               const ViewScale& scale,
                                                               ViewBlock& block,
                                                               support::Diagnostics& diagnostics);

}  // namespace gmsim::io
