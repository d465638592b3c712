// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "engine/rewrite.h"
#include "engine/tear_model.h"

namespace gmsim::engine {

/// Applies the rule (of one hook) or the operation that a scene names at a dart.
RewriteOutcome apply_change(Rewriter& rewriter, const NamedChange& change, DartId dart,
                            const Arguments& arguments);
/// The same at each of the darts: in turn, or all at once for a rule that changes values only.
RewriteOutcome apply_change(Rewriter& rewriter, const NamedChange& change,
                            std::span<const DartId> darts, const Arguments& arguments);

}  // namespace gmsim::engine
