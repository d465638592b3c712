// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "compile/specialise.h"
#include "engine/force_matches.h"
#include "engine/force_program.h"
#include "engine/ir_evaluate.h"
#include "support/diagnostic.h"

namespace gmsim::engine {

/// "a = 4, b = 7": the nodes of a match, as the rule names them.
[[nodiscard]] std::string match_text(const compile::ItemBody& body, const ForceMatch& match);

/// What to say of a result that is not finite: the place is the first operation whose result is not
/// finite although what it is made from is. `evaluator` has run `program` for the match.
[[nodiscard]] support::Diagnostic non_finite(const compile::ItemBody& body, const ForceMatch& match,
                                             const ForceProgram& program,
                                             const IrEvaluator<double>& evaluator);
/// The warning for a match where a vector has no direction. `evaluator` has run the direction
/// program.
[[nodiscard]] support::Diagnostic no_direction(const compile::ItemBody& body,
                                               const ForceMatch& match,
                                               const ForceProgram& program,
                                               const IrEvaluator<double>& evaluator);

}  // namespace gmsim::engine
