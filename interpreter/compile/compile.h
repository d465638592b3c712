// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <string_view>

#include "check/checked_rule.h"
#include "compile/program.h"

namespace gmsim::compile {

/// Plans for everything in a checked library. Cannot fail: what is checked can be compiled.
[[nodiscard]] Program compile_program(const check::RuleLibrary& library);

/// The plan of one pattern. `hooks` are nodes of `pattern`; `steps` and `parameters` are its
/// predicates; `width` the columns of its table (0: as many as nodes).
[[nodiscard]] MatchPlan compile_match(const check::Pattern& pattern,
                                      const std::vector<check::NodeIndex>& hooks,
                                      const std::vector<check::Parameter>& parameters,
                                      const std::vector<check::Step>& steps,
                                      std::uint32_t width = 0);
/// The plan of a rule's right side.
[[nodiscard]] RewritePlan compile_rewrite(const check::Rule& rule,
                                          const gmap::EmbeddingSchema& schema, int dimension);
[[nodiscard]] Rule compile_rule(const check::Rule& rule, const gmap::EmbeddingSchema& schema);

/// `--dump plan`: every item, or those called `only`.
void print_program(const Program& program, std::ostream& out, std::string_view only = {});

}  // namespace gmsim::compile
