// SPDX-License-Identifier: MIT
#pragma once

#include "engine/force_matches.h"
#include "engine/force_program.h"
#include "engine/ir_evaluate.h"

namespace gmsim::engine {

/// Evaluates a program for one match, node by node; `evaluator` is one of the program's graph.
void evaluate_match(const ForceProgram& program, const ForceMatch& match, const ForceMoment& moment,
                    const gmap::EmbeddingStore& store, IrEvaluator<double>& evaluator);

}  // namespace gmsim::engine
