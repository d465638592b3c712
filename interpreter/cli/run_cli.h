// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <span>
#include <string>

namespace gmsim::cli {

/// What the program returns to the shell.
enum ExitCode : int {
  kDone = 0,
  kStopped = 1,        ///< a check of the run: unstable, diverged, expectation not met
  kRejected = 2,       ///< command line, rule or scene rejected
  kInputOutput = 3,    ///< reading or writing failed
  kInterrupted = 4,    ///< stopped at a limit or by Ctrl-C with everything written
  kInternalError = 70  ///< a bug of gmsim
};

/// Runs one command line (without the program name). Results go to `out`, diagnostics and
/// progress to `err`; nothing else of the process is touched, so tests call it directly.
int run_cli(std::span<const std::string> arguments, std::ostream& out, std::ostream& err);

}  // namespace gmsim::cli
