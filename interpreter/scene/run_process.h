// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gmsim::scene {

struct ProcessResult {
  int exit_code = 0;   ///< 128 + signal number when it was killed
  std::string output;  ///< standard output and error together, at most 64 kB of it
};

/// Runs a program, looked up on PATH, with exactly these arguments: no shell takes part. Its
/// standard input is empty. Nothing when it cannot be started.
[[nodiscard]] std::optional<ProcessResult> run_process(const std::vector<std::string>& arguments);

}  // namespace gmsim::scene
