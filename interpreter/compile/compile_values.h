// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "compile/program.h"
#include "compile/value_program.h"

namespace gmsim::compile {

/// The program for the values that a rule assigns. `in_use` says of each embedding whether it is
/// stored; assignments to others are left out.
///
/// Both branches of an `if`, and both sides of `and` and `or`, are computed. What has no value
/// there makes the machine give up, and the trees are evaluated, which look at what is needed
/// alone.
[[nodiscard]] ValueProgram compile_values(const Rule& rule, const gmap::EmbeddingSchema& schema,
                                          const std::vector<bool>& in_use);

}  // namespace gmsim::compile
