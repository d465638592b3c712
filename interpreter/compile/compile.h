// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <string_view>

#include "check/checked_rule.h"
#include "compile/program.h"

namespace gmsim::compile {

/// Plans for everything in a checked library. Cannot fail: what is checked can be compiled.
[[nodiscard]] Program compile_program(const check::RuleLibrary& library);

/// The plan that finds the links of a pattern, without predicates. `hooks` are nodes of `pattern`.
[[nodiscard]] MatchPlan compile_pattern(const check::Pattern& pattern,
                                        const std::vector<check::NodeIndex>& hooks);
/// Adds parameter defaults, lets and conditions to a plan. Those that cannot fail for want of a
/// complete match are judged as soon as their darts are known.
void add_predicates(MatchPlan& plan, const std::vector<check::Parameter>& parameters,
                    const std::vector<check::Step>& steps, const gmap::EmbeddingSchema& schema);
/// The plan of a rule's right side.
[[nodiscard]] RewritePlan compile_rewrite(const check::Rule& rule,
                                          const gmap::EmbeddingSchema& schema);
[[nodiscard]] Rule compile_rule(const check::Rule& rule, const gmap::EmbeddingSchema& schema);

/// What an interaction or a criterion computes.
[[nodiscard]] InteractionBody compile_body(const check::Interaction& interaction);
[[nodiscard]] CriterionBody compile_body(const check::Criterion& criterion);

/// `--dump plan`: every item, or those called `only`.
void print_program(const Program& program, std::ostream& out, std::string_view only = {});

}  // namespace gmsim::compile
