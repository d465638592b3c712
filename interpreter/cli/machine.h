// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace gmsim::cli {

/// What a measurement was made with.
struct Machine {
  std::string processor;  ///< as the system names it
  unsigned cores = 0;
  double load = 0;        ///< average of the last minute
  std::string compiler, build;
};
[[nodiscard]] Machine this_machine();

}  // namespace gmsim::cli
