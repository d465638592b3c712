// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/matcher.h"
#include "stdlib/test_block.h"

namespace gmsim::test {

/// Runs a block and returns what did not come out as the block says; empty when all did.
[[nodiscard]] std::vector<std::string> run_block(const TestBlock& block,
                                                 engine::MatcherKind matcher);

}  // namespace gmsim::test
