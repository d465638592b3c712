// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "check/item_context.h"

namespace gmsim::check {

/// Reports what `expr` reaches that has no derivative with respect to positions: jumps (floor), forces,
/// derived values and results that are computed from positions. What stands in frozen(…) is not looked
/// at. `what` names the place in messages.
void check_differentiable(const ExprPtr& expr, const std::string& what, ItemContext& context);

}  // namespace gmsim::check
