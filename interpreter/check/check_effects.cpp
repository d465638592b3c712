// SPDX-License-Identifier: MIT
#include "check/passes.h"

namespace gmsim::check {

Footprint footprint(const Rule&) { return {}; }
Footprint footprint(const Interaction&) { return {}; }
Footprint footprint(const Criterion&) { return {}; }
Footprint footprint(const Operation&, const RuleLibrary&) { return {}; }

}  // namespace gmsim::check
