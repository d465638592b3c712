// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "engine/matcher.h"

namespace gmsim::engine {

/// Which dart of an orbit a match starts from.
struct Enumeration {
  OrbitType orbit;                            ///< at most one match for each orbit of this type
  const types::Expr* first = nullptr;         ///< `first d where …`: only darts for which it holds
  Slot first_dart{};                          ///< the dart that `first` speaks of
  std::optional<EmbeddingId> presence = {};   ///< only orbits that carry this mark
  std::function<bool(DartId)> where = {};     ///< only these darts (a scene's `where`)
};

/// Does a match of a one-hook pattern start from a dart?
enum class Start : std::uint8_t {
  No,        ///< the pattern does not hold there, or `first` rests on an optional value that is missing
  NotFirst,  ///< it holds, the condition of `first` does not
  Yes
};
/// `first` may be null. The match is in `found` and `frame`, which holds the parameters before. No
/// after an error, which is in `error` then.
[[nodiscard]] Start start_at(Matcher& matcher, const compile::MatchPlan& plan,
                             const types::Expr* first, Slot first_dart, DartId dart, Frame& frame,
                             Match& found, std::optional<support::Diagnostic>& error);
/// Of an orbit of which no dart meets the condition of `first`; `dart` is its smallest.
[[nodiscard]] support::Diagnostic no_first(OrbitType orbit, DartId dart, const types::Expr& first);

/// All matches of a one-hook pattern: for each orbit, ascending by smallest dart, the match at its
/// first dart (ascending) for which the pattern holds. `visit(dart, match, frame)` may not change
/// the state. Stops at the first error and returns it; `arguments` are the pattern's parameters.
std::optional<support::Diagnostic> for_each_match(
    Matcher& matcher, const State& state, const compile::MatchPlan& plan, std::uint32_t frame_size,
    const Arguments& arguments, const Enumeration& enumeration,
    const std::function<void(DartId, const Match&, Frame&)>& visit);

/// The hook darts of all matches of a rule, one for each orbit of `to`; the orbit of the hook's
/// label is `rule.match.hook_orbit()`.
struct Candidates {
  std::vector<DartId> darts;
  std::optional<support::Diagnostic> error = std::nullopt;
};
[[nodiscard]] Candidates candidates(Matcher& matcher, const State& state,
                                    const compile::Rule& rule, const Arguments& arguments,
                                    const Enumeration& enumeration);

}  // namespace gmsim::engine
