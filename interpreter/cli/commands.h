// SPDX-License-Identifier: MIT
#pragma once

#include "cli/session.h"

namespace gmsim::cli {

/// Each command returns the exit code.
int run_check(Session& session);
int run_list(Session& session);
int run_dump(Session& session);
int run_apply(Session& session);
int run_fuzz(Session& session);

}  // namespace gmsim::cli
