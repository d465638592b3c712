// SPDX-License-Identifier: MIT
#include "support/check.h"

namespace gmsim::support {

void internal_error(const char* file, int line, const std::string& what) {
  throw InternalError(std::string(file) + ":" + std::to_string(line) + ": " + what);
}

}  // namespace gmsim::support
