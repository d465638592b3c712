// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <iosfwd>
#include <span>
#include <string>

#include "golden/golden_case.h"

namespace gmsim::golden {

/// How a command line is run: the program's own entry point, or a stand-in.
using Cli = std::function<int(std::span<const std::string>, std::ostream&, std::ostream&)>;

enum class Mode { Compare, Update };

/// Runs all command lines of a case up to the first that fails and compares what was printed with
/// the expectations (or, to update, writes them). Complaints go to `report`; true when there are
/// none. Paths of the scratch folder are shown as %t.
bool run_case(const Case& which, const Cli& cli, Mode mode, std::ostream& report);

}  // namespace gmsim::golden
