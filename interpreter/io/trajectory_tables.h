// SPDX-License-Identifier: MIT
#pragma once

// Internal to this module: the tables of a trajectory and their records.

#include <deque>
#include <vector>

#include "io/growing_dataset.h"
#include "io/hdf5_handles.h"
#include "io/trajectory_schema.h"

namespace gmsim::io {

/// Room for the texts that are known only at the end of a run.
inline constexpr std::size_t kShortText = 64;

/// A row of /gmsim/events, as in the file: packed, little-endian.
struct EventRecord {
  std::int64_t step, frame;
  double time;
  std::int32_t rule, criterion;
  double value, threshold;
  std::int32_t dart;
  double position[3];
  std::int64_t cells_begin;
  std::int32_t cells_count, new_vertices;
};
/// A row of /gmsim/epochs.
struct EpochRecord {
  std::int64_t step;
  double time;
  std::int64_t first_event, darts, changes_begin;
};
[[nodiscard]] Hdf5Handle event_memory_type();
[[nodiscard]] Hdf5Handle epoch_memory_type();

/// The datasets of one field.
struct FieldTables {
  GrowingDataset values;
  GrowingDataset offsets;  ///< first row in `values`, one per frame
  GrowingDataset sizes;    ///< Frame: [components, tuples]; Orbit: rows, one per frame
  GrowingDataset darts;    ///< Orbit: a dart of each row
};

/// Every growing dataset of a file, all made before the first frame.
struct TrajectoryTables {
  // /VTKHDF, a row (or slice) per epoch
  GrowingDataset point_counts, cell_counts, id_counts;
  GrowingDataset connectivity, offsets, types;
  GrowingDataset face_counts, face_id_counts, polyhedron_id_counts;
  GrowingDataset face_connectivity, face_offsets, polyhedron_faces, polyhedron_offsets;
  // /VTKHDF, a slice per frame
  GrowingDataset points;
  // /VTKHDF/Steps, a row per frame
  GrowingDataset times, part_offsets, part_counts, point_offsets, cell_offsets, id_offsets;
  GrowingDataset face_id_offsets, polyhedron_id_offsets, face_offset_offsets;
  // /gmsim
  GrowingDataset frame_steps, events, event_cells, epochs, changes, extents;
  std::deque<FieldTables> fields;
  std::deque<GrowingDataset> series;

  /// Makes everything in an empty file, and writes what is fixed.
  void create(hid_t file, const RunDescription& run);
  /// The datasets that exist, in the order of the `extents` columns, itself last.
  [[nodiscard]] std::vector<GrowingDataset*> all();
};

/// Column names of /gmsim/extents: paths of the datasets without the first slash.
[[nodiscard]] std::vector<std::string> read_extent_names(hid_t file);

}  // namespace gmsim::io
