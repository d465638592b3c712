// SPDX-License-Identifier: MIT
#include "cli/version.h"

#include "cli/commit.h"

namespace gmsim::cli {

const char* version() {
  return GMSIM_VERSION;
}

const char* commit() {
  return kCommit;
}

const char* version_text() {
  return "gmsim " GMSIM_VERSION;
}

}  // namespace gmsim::cli
