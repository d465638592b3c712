// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "cli/session.h"
#include "engine/simulation.h"
#include "scene/scene.h"

namespace gmsim::cli {

/// One way to advance a scene, and what it costs and yields.
struct StudyPoint {
  std::string method;
  bool adaptive = false;
  double dt = 0;    ///< s, of methods with a fixed step
  double rtol = 0;  ///< of those that choose their steps

  std::string problem;               ///< why there is no result; empty: there is one
  std::uint64_t steps = 0, evaluations = 0;
  std::uint64_t state_hash = 0;
  double dt_over_limit = 0;          ///< 0 where nothing limits the step
  std::vector<double> positions;     ///< m, at the end, 3 a vertex
  double e_end = 0, e_rms = 0;       ///< errors, in diagonals of the mesh
  bool resolved = false;             ///< well above the floor of the reference
  std::vector<double> wall;          ///< s of each timed run
  double cpu_over_wall = 1;          ///< smallest of the timed runs
  bool disturbed = false;            ///< something else took the processor

  [[nodiscard]] bool has_result() const { return problem.empty(); }
};

double median(std::vector<double> values);
/// Median distance from the median.
double median_deviation(const std::vector<double>& values);

/// The scene with the method and the step of a point, ready to be run again and again.
class StudyScene {
 public:
  /// Null after an error of the scene itself, which is reported. A step that the scene cannot be
  /// run with is the point's `problem`.
  [[nodiscard]] static std::unique_ptr<StudyScene> load(Session& session, StudyPoint& point);

  /// One run to the end; fills in what does not depend on the machine.
  void run(StudyPoint& point) const;
  /// `count` runs of which none is looked at, and their time. False when their end is not that of
  /// the point.
  bool time(StudyPoint& point, std::uint32_t count) const;

  [[nodiscard]] const scene::Scene& scene() const { return *scene_; }
  /// m, diagonal of the box around the mesh at the start.
  [[nodiscard]] double diagonal() const;

 private:
  StudyScene(Session& session, std::unique_ptr<scene::Scene> scene);
  [[nodiscard]] std::unique_ptr<engine::Simulation> make(support::Diagnostics& diagnostics) const;
  /// False after an error.
  bool advance(engine::Simulation& simulation, support::Diagnostics& diagnostics) const;

  Session& session_;
  std::unique_ptr<scene::Scene> scene_;
};

}  // namespace gmsim::cli
