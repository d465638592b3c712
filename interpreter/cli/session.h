// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <optional>
#include <string>

#include "check/check.h"
#include "cli/options.h"
#include "support/diagnostic.h"
#include "support/source_map.h"

namespace gmsim::cli {

/// What every command shares: texts, diagnostics, traces and the two streams.
class Session {
 public:
  Session(const Options& options, std::ostream& out, std::ostream& err);

  [[nodiscard]] check::CheckedRules check_rules();
  /// Prints what was reported since the last call; kDone, kRejected or kInputOutput.
  int finish();
  /// Reads a file into `sources`; reports when it cannot.
  std::optional<support::FileId> read(const std::string& path);

  const Options& options;
  std::ostream& out;
  std::ostream& err;
  support::SourceMap sources;
  support::Diagnostics diagnostics;
};

}  // namespace gmsim::cli
