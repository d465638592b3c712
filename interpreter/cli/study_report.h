// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "cli/machine.h"
#include "cli/study_point.h"

namespace gmsim::cli {

/// All that a study says.
struct StudyReport {
  std::string scene;            ///< its path
  std::string scene_hash;       ///< SHA-256 of the scene with all defaults
  double duration = 0;          ///< s, simulated
  double diagonal = 0;          ///< m
  std::size_t points_of_mesh = 0;
  unsigned threads = 1;
  Machine machine;
  StudyPoint reference, coarser;  ///< the second at twice the step of the first
  double floor_end = 0, floor_rms = 0;
  std::vector<StudyPoint> points;
  std::string command_line;

  /// Errors of every point against the reference, the floor, and which errors are resolved.
  void compare();
  /// The spread of timings is too wide to call anything faster.
  [[nodiscard]] bool is_noisy() const;
};

[[nodiscard]] std::string study_table(const StudyReport& report);
[[nodiscard]] std::string study_csv(const StudyReport& report);
[[nodiscard]] std::string study_json(const StudyReport& report);

}  // namespace gmsim::cli
