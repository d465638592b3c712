// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "check/checked_rule.h"
#include "support/tiny_map.h"

namespace gmsim::tests {

/// A map in which the rule matches at the returned hook darts, completed at random around the
/// match; empty when none was found (a left side that contradicts itself).
struct Host {
  TinyMap map;
  std::vector<int> hook_darts;
};
[[nodiscard]] std::optional<Host> host_of(const check::Rule& rule, Random& random);

}  // namespace gmsim::tests
