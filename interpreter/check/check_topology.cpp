// SPDX-License-Identifier: MIT
#include "check/passes.h"

namespace gmsim::check {

bool check_topology(const Rule&, support::Diagnostics&) { return true; }
bool check_match(const Pattern&, NodeIndex, int, support::Diagnostics&) { return true; }

}  // namespace gmsim::check
