// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <iosfwd>

namespace gmsim::golden {

/// Every kind of diagnostic is seen in an expected .err file below `root`, or stands with a reason
/// in root/uncovered_kinds.txt ("kind  reason", # comments). Complaints go to `report`, also about
/// exceptions that are no kind, lack a reason or are covered after all; true when there are none.
bool check_coverage(const std::filesystem::path& root, std::ostream& report);

}  // namespace gmsim::golden
