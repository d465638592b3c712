// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "io/mesh_frame.h"
#include "io/trajectory_schema.h"
#include "support/diagnostic.h"

namespace gmsim::io {

/// The values of a field did not change since the last frame: they are not stored again.
struct Unchanged {};
/// Rows of a field, `components` numbers each, in the order of points, cells or `darts`.
using FieldValues = std::variant<Unchanged, std::span<const double>, std::span<const float>,
                                 std::span<const std::int64_t>, std::span<const std::int32_t>>;
struct FrameField {
  FieldValues values;
  std::span<const std::int32_t> darts = {};  ///< fields on orbits: a dart of each row
};

/// A new mesh, from this frame on.
struct NewTopology {
  const MeshTopology* mesh = nullptr;
  std::int64_t darts = 0;  ///< one past the largest dart id
  /// Darts that changed since the epoch before, or are new: id, alpha_0 … alpha_n; -1: removed.
  std::span<const std::int32_t> changes = {};
};

/// One frame. Points are given every time; `fields` in the order of the description.
struct FrameData {
  double time = 0;  ///< s
  std::int64_t step = 0;
  std::span<const std::array<double, 3>> points;
  std::optional<NewTopology> topology;  ///< needed in the first frame
  std::span<const FrameField> fields;
  std::span<const TearEvent> events;  ///< that this frame is the first to show
};

struct TrajectoryOptions {
  bool force = false;  ///< write over a NAME.part that an earlier run left behind
  bool sync = false;   ///< make the disk store every frame before it counts as written
};

/// Where a run named `path` is written until it ends: the same with ".part" behind.
[[nodiscard]] std::filesystem::path part_path(const std::filesystem::path& path);

/// Writes a run as a temporal VTKHDF file with gmsim's own data beside it (docs/output.md).
///
/// While the run goes on the file is `NAME.part`, and every frame for which write_frame returned
/// true can be got back from it whatever happens to this process: see recover.h. close() renames
/// it.
///
/// After a failure (disk full, …) write_frame and close return false; the writer then does not
/// touch the file any more, not even to close it, and neither does the process when it exits, so
/// that the frames before stay readable. The caller ends the run. Several writers may exist at a
/// time.
class TrajectoryWriter {
 public:
  /// Makes NAME.part with everything but frames. Nothing after an error, which is reported as
  /// file-error (the file) or usage (a NAME.part is there already, or the description is unsound).
  [[nodiscard]] static std::unique_ptr<TrajectoryWriter> create(const std::filesystem::path& path,
                                                                const RunDescription& run,
                                                                const TrajectoryOptions& options,
                                                                support::Diagnostics& diagnostics);
  /// Leaves NAME.part behind unless close() was called.
  ~TrajectoryWriter();
  TrajectoryWriter(const TrajectoryWriter&) = delete;
  TrajectoryWriter& operator=(const TrajectoryWriter&) = delete;

  /// A row of the time series: the columns of the description, one after another. It is written
  /// with the next frame, or at the end.
  void add_report(std::span<const double> row);
  /// True once the frame is safe.
  bool write_frame(const FrameData& frame, support::Diagnostics& diagnostics);
  /// Frames that are safe.
  [[nodiscard]] std::int64_t frames() const;
  /// Marks the file as complete and gives it its name; without a single frame the file is removed
  /// with a warning. `state_hash`: of the final state; `ending`: how the run ended ("finished",
  /// "interrupted", "stopped"); at most 64 characters each.
  bool close(std::string_view state_hash, support::Diagnostics& diagnostics,
             std::string_view ending = "finished");

 private:
  struct Implementation;
  explicit TrajectoryWriter(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace gmsim::io
