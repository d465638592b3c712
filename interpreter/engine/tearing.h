// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/rewrite.h"
#include "engine/tear_requests.h"

namespace gmsim::engine {

/// What the requests of one step led to.
struct TearOutcome {
  std::vector<TearEvent> events;
  std::uint64_t dropped = 0;       ///< requests whose pattern no longer held when their turn came
  Effects effects;                 ///< of all changes together
  std::optional<support::Diagnostic> error = std::nullopt;  ///< everything before it stays applied
};

/// Applies what criteria asked for (docs/language.md, the step): in the order of the requests, each
/// matched again when its turn comes. A request whose orbit was split meanwhile passes to every
/// part of it, so that the result does not depend on the order of darts.
class Tearing {
 public:
  Tearing(Rewriter& rewriter, std::span<const TearPairing> pairings);

  void apply(std::span<const TearRequest> requests, TearOutcome& outcome);

 private:
  using Failure = std::optional<support::Diagnostic>;

  void apply_one(const TearRequest& request, TearOutcome& outcome);
  /// The darts of a request's orbit at which its pattern holds now: one for each part.
  void find_parts(const TearRequest& request, std::vector<DartId>& parts);
  [[nodiscard]] bool matches(const compile::RootedPattern& pattern, DartId hook);
  Failure gather_arguments(const TearRequest& request, DartId dart, Arguments& arguments);
  void run(const TearRequest& request, DartId dart, TearOutcome& outcome);

  Rewriter& rewriter_;
  TreeEvaluator evaluator_;
  std::span<const TearPairing> pairings_;
  Frame frame_;
  Match match_;
};

}  // namespace gmsim::engine
