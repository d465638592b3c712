// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "cli/frame_column.h"
#include "engine/force_probe.h"
#include "engine/simulation.h"
#include "engine/tree_eval.h"
#include "io/mesh_frame_from_map.h"
#include "io/point_numbering.h"
#include "io/trajectory_writer.h"
#include "scene/scene.h"
#include "support/source_map.h"

namespace gmsim::cli {

/// What is written to the time series at the end of a step.
struct RunReport {
  engine::StepReport step;
  engine::Totals totals;
  double max_elongation = 1;
};

/// The file of a run: frames with the fields that its scene asks for, and the time series.
class RunOutput {
 public:
  struct Options {
    std::filesystem::path path;
    std::string command_line;
    bool force = false;
  };
  /// Makes the file, with everything but frames. Nothing after an error, which is reported.
  [[nodiscard]] static std::unique_ptr<RunOutput> create(const scene::Scene& scene,
                                                         const support::SourceMap& sources,
                                                         const Options& options,
                                                         support::Diagnostics& diagnostics);

  /// Writes the state of the simulation as it is now. False after an error.
  bool write_frame(engine::Simulation& simulation, support::Diagnostics& diagnostics);
  /// Writes the state at a time within the last step of an adaptive method.
  bool write_frame_at(double time, const engine::StepReport& step,
                      engine::Simulation& simulation, support::Diagnostics& diagnostics);
  /// Takes note of what a step did to the map, for the next frame.
  void note(const engine::StepReport& step);
  void add_report(const RunReport& report, const engine::Simulation& simulation);
  bool close(std::uint64_t state_hash, std::string_view ending, support::Diagnostics& diagnostics);

  [[nodiscard]] std::int64_t frames() const { return frames_; }
  [[nodiscard]] double last_time() const { return last_time_; }  ///< s, of the last frame

 private:
  explicit RunOutput(const scene::Scene& scene);
  /// False after an error.
  bool make_columns(support::Diagnostics& diagnostics);
  void make_mesh();
  [[nodiscard]] io::RunDescription describe(const support::SourceMap& sources,
                                            const Options& options) const;
  /// The new mesh and the darts whose links changed, after the map has changed.
  io::NewTopology take_topology();
  bool write_state(double time, std::int64_t step, support::Diagnostics& diagnostics);
  [[nodiscard]] std::span<const engine::DartId> darts_of(const FrameColumn& column);
  /// Of the map as it is, which the last frame may not show.
  [[nodiscard]] std::size_t cell_count() const;

  const scene::Scene& scene_;
  const gmap::OrbitIndex& vertices_;
  types::EmbeddingId position_;
  io::PointNumbering numbering_;
  io::MapFrame mesh_;
  std::vector<FrameColumn> columns_;
  std::unique_ptr<engine::ForceProbe> probe_;  // when a field reads forces
  std::vector<engine::DartId> orbit_darts_;
  std::unique_ptr<io::TrajectoryWriter> writer_;
  std::vector<std::int32_t> links_;    // of all darts, as the file has them
  std::vector<std::int32_t> changes_;  // as in NewTopology
  std::vector<io::TearEvent> events_;  // since the last frame
  bool map_changed_ = false;
  std::int64_t frames_ = 0;
  double last_time_ = 0;
};

/// Velocities at a time within the last step, the derivative of the method's dense output, which
/// is a polynomial of degree five (vertex rows, 3 numbers each). `begin`, `end`: of the step.
[[nodiscard]] std::vector<double> dense_velocities(const engine::Simulation& simulation,
                                                   double begin, double end, double time);

}  // namespace gmsim::cli
