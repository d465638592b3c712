// SPDX-License-Identifier: MIT
#include "engine/apply_change.h"

#include "engine/operation.h"

namespace gmsim::engine {

RewriteOutcome apply_change(Rewriter& rewriter, const NamedChange& change, DartId dart,
                            const Arguments& arguments) {
  const compile::Program& program = rewriter.state().program;
  if (change.operation)
    return OperationRunner(rewriter).run(program.operations[change.target], dart, arguments);
  return rewriter.apply(program.rules[change.target], {&dart, 1}, arguments);
}

RewriteOutcome apply_change(Rewriter& rewriter, const NamedChange& change,
                            std::span<const DartId> darts, const Arguments& arguments) {
  const compile::Program& program = rewriter.state().program;
  if (change.operation)
    return OperationRunner(rewriter).run_each(program.operations[change.target], darts, arguments);
  return rewriter.apply_everywhere(program.rules[change.target], darts, arguments);
}

}  // namespace gmsim::engine
