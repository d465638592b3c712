// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "check/environment.h"
#include "check/load_rules.h"

namespace gmsim::check {

/// What stays after a check for expressions that come later.
struct Checking {
  Checking(const LoadedRules& rules, support::Diagnostics& diagnostics)
      : items(rules, diagnostics) {}
  ItemTable items;
  std::array<Environment, 3> environments;
};
[[nodiscard]] Checking& checking_of(const CheckedRules& rules);

}  // namespace gmsim::check
