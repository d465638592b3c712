// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/mesh_frame.h"
#include "io/trajectory_schema.h"
#include "support/diagnostic.h"

namespace gmsim::io {

/// A tear as it stands in the file.
struct StoredEvent {
  TearEvent event;
  std::int64_t frame = 0;  ///< the first frame that shows it
};

/// A stretch of frames with one mesh.
struct StoredEpoch {
  std::int64_t step = 0;
  double time = 0;
  std::int64_t first_event = 0;
  std::int64_t darts = 0;
  std::vector<std::int32_t> changes;  ///< as NewTopology::changes
};

/// A field on orbits that are neither vertices nor cells of the mesh.
struct OrbitValues {
  DataArray array;
  std::vector<std::int32_t> darts;  ///< one of each row's orbit
};

/// What a file holds besides the description of its run.
struct TrajectorySummary {
  bool complete = false;  ///< the run closed its file
  std::int64_t frames = 0, epochs = 0, events = 0, reports = 0;
  std::string state_hash;  ///< of the final state
  std::string ending;      ///< how the run ended: "finished", "interrupted", "stopped"; or empty
};

/// Reads a finished file, or the frames that are safe of a `.part`, also while it is written.
/// Frames are numbered from 0. Every function returns nothing after an error, which is reported as
/// file-error; a damaged file never gives tables that point outside of each other.
class TrajectoryReader {
 public:
  [[nodiscard]] static std::unique_ptr<TrajectoryReader> open(const std::filesystem::path& path,
                                                              support::Diagnostics& diagnostics);
  ~TrajectoryReader();
  TrajectoryReader(const TrajectoryReader&) = delete;
  TrajectoryReader& operator=(const TrajectoryReader&) = delete;

  [[nodiscard]] const RunDescription& run() const;
  [[nodiscard]] const TrajectorySummary& summary() const;
  [[nodiscard]] std::span<const double> times() const;           ///< s, of each frame
  [[nodiscard]] std::span<const std::int64_t> steps() const;     ///< of each frame
  [[nodiscard]] std::span<const std::int64_t> epoch_of() const;  ///< of each frame

  /// Points and cells of a frame, and its fields on them if asked for.
  [[nodiscard]] std::optional<MeshFrame> read_frame(std::int64_t frame, bool with_fields,
                                                    support::Diagnostics& diagnostics) const;
  /// One field (a position in run().fields) on points, cells or the frame.
  [[nodiscard]] std::optional<DataArray> read_field(std::size_t field, std::int64_t frame,
                                                    support::Diagnostics& diagnostics) const;
  [[nodiscard]] std::optional<OrbitValues> read_orbit_field(
      std::size_t field, std::int64_t frame, support::Diagnostics& diagnostics) const;
  /// A column of the time series (a position in run().series), all reports.
  [[nodiscard]] std::optional<std::vector<double>> read_series(
      std::size_t column, support::Diagnostics& diagnostics) const;
  [[nodiscard]] std::optional<std::vector<StoredEvent>> read_events(
      support::Diagnostics& diagnostics) const;
  [[nodiscard]] std::optional<std::vector<StoredEpoch>> read_epochs(
      support::Diagnostics& diagnostics) const;

 private:
  struct Implementation;
  explicit TrajectoryReader(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace gmsim::io
