// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <iosfwd>
#include <optional>
#include <string>

#include "check/check.h"
#include "cli/options.h"
#include "support/diagnostic.h"
#include "support/source_map.h"
#include "support/trace.h"

namespace gmsim::cli {

/// What every command shares: texts, diagnostics, traces and the two streams.
class Session {
 public:
  Session(const Options& options, std::ostream& out, std::ostream& err);

  [[nodiscard]] check::CheckedRules check_rules() { return check_rules(options.files); }
  [[nodiscard]] check::CheckedRules check_rules(const std::vector<std::string>& files);
  /// Prints what was reported since the last call; kDone, kRejected or kInputOutput.
  int finish();
  /// Prints warnings before something that takes long; only while there are no errors.
  void print_warnings();
  /// Reads a file into `sources`; reports when it cannot.
  std::optional<support::FileId> read(const std::string& path);

  const Options& options;
  std::ostream& out;
  std::ostream& err;
  support::SourceMap sources;
  support::Diagnostics diagnostics;
  support::Trace trace;
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
};

}  // namespace gmsim::cli
