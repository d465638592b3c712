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
int run_scene(Session& session);
int run_verify(Session& session);
int run_explain(Session& session);
int run_study(Session& session);
int run_info(Session& session);
int run_export(Session& session);
int run_recover(Session& session);
int run_snapshot(Session& session);
int run_view(Session& session);

}  // namespace gmsim::cli
