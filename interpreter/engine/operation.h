// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "engine/rewrite.h"

namespace gmsim::engine {

/// Runs operations: all or nothing, so a rule in it that cannot be applied undoes the whole.
/// A `for` collects the darts for which its condition holds before its body runs; each pass judges
/// the condition again and is skipped when it is false by then, or when its dart is gone.
class OperationRunner {
 public:
  explicit OperationRunner(Rewriter& rewriter) : rewriter_(rewriter) {}

  RewriteOutcome run(const compile::Operation& operation, DartId dart,
                     const Arguments& arguments = {});
  /// Runs at each of the darts in turn; each run is all or nothing by itself. A run that does not
  /// apply is counted in `effects.dropped`; stops at the first error.
  RewriteOutcome run_each(const compile::Operation& operation, std::span<const DartId> darts,
                          const Arguments& arguments = {});

 private:
  Rewriter& rewriter_;
};

}  // namespace gmsim::engine
