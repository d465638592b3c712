// SPDX-License-Identifier: MIT
#include "engine/enumerate.h"

#include <fmt/format.h>

#include <algorithm>

#include "gmap/orbit_walk.h"

namespace gmsim::engine {

namespace {

using Diagnostic = std::optional<support::Diagnostic>;

/// Goes through the orbits and tries their darts.
class Enumerator {
 public:
  Enumerator(Matcher& matcher, const State& state, const compile::MatchPlan& plan,
             const Enumeration& enumeration)
      : matcher_(matcher), state_(state), plan_(plan), wanted_(enumeration) {}

  Diagnostic run(std::uint32_t frame_size, const Arguments& arguments,
                 const std::function<void(DartId, const Match&, Frame&)>& visit) {
    std::vector<bool> seen(state_.map.dart_end(), false);
    std::vector<DartId> orbit;
    Frame frame;
    Match match;
    for (std::uint32_t i = 0; i < seen.size(); ++i) {
      if (seen[i] || !state_.map.alive(DartId{i})) continue;
      orbit.clear();
      gmap::for_each_dart(state_.map, wanted_.orbit, DartId{i}, [&](DartId d) {
        seen[types::index(d)] = true;
        orbit.push_back(d);
      });
      if (!carries(DartId{i})) continue;
      std::sort(orbit.begin(), orbit.end());
      bool without_first = false;
      const auto at = std::find_if(orbit.begin(), orbit.end(), [&](DartId d) {
        frame.reset(frame_size);
        for (const auto& [slot, value] : arguments) frame.set(slot, value);
        return holds(d, frame, match, without_first) || error_;
      });
      if (error_) return error_;
      if (at != orbit.end()) {
        visit(*at, match, frame);
      } else if (without_first) {
        return no_first(wanted_.orbit, DartId{i}, *wanted_.first);
      }
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] bool carries(DartId d) const {
    if (!wanted_.presence) return true;
    if (!state_.store.in_use(*wanted_.presence)) return false;
    const std::span<const double> mark = state_.store.get(*wanted_.presence, d);
    return !mark.empty() && mark[0] != 0.0;
  }

  bool holds(DartId d, Frame& frame, Match& match, bool& without_first) {
    if (wanted_.where && !wanted_.where(d)) return false;
    const Start start =
        start_at(matcher_, plan_, wanted_.first, wanted_.first_dart, d, frame, match, error_);
    without_first = without_first || start == Start::NotFirst;
    return start == Start::Yes;
  }

  Matcher& matcher_;
  const State& state_;
  const compile::MatchPlan& plan_;
  const Enumeration& wanted_;
  Diagnostic error_;
};

}  // namespace

Start start_at(Matcher& matcher, const compile::MatchPlan& plan, const types::Expr* first,
               Slot first_dart, DartId dart, Frame& frame, Match& found,
               std::optional<support::Diagnostic>& error) {
  if (!matcher.match(plan, {&dart, 1}, frame, found)) {
    if (matcher.failure().reason == MatchFailure::Reason::Error) error = matcher.failure().error;
    return Start::No;
  }
  if (first == nullptr) return Start::Yes;
  frame.set(first_dart, dart);
  bool holds = false;
  if (!matcher.evaluator().evaluate_bool(*first, frame, holds)) {
    EvalFailure failure = matcher.evaluator().take_failure();
    if (!failure.missing_optional) error = std::move(failure.diagnostic);
    return Start::No;
  }
  return holds ? Start::Yes : Start::NotFirst;
}

support::Diagnostic no_first(OrbitType orbit, DartId dart, const types::Expr& first) {
  return {support::DiagnosticKind::NoMatch,
          fmt::format("no dart of the {} orbit of dart {} meets the condition of `first`",
                      types::to_string(orbit), types::index(dart)),
          first.span};
}

std::optional<support::Diagnostic> for_each_match(
    Matcher& matcher, const State& state, const compile::MatchPlan& plan, std::uint32_t frame_size,
    const Arguments& arguments, const Enumeration& enumeration,
    const std::function<void(DartId, const Match&, Frame&)>& visit) {
  return Enumerator(matcher, state, plan, enumeration).run(frame_size, arguments, visit);
}

Candidates candidates(Matcher& matcher, const State& state, const compile::Rule& rule,
                      const Arguments& arguments, const Enumeration& enumeration) {
  Candidates result;
  result.error =
      for_each_match(matcher, state, rule.match, rule.frame_size, arguments, enumeration,
                     [&](DartId d, const Match&, Frame&) { result.darts.push_back(d); });
  return result;
}

}  // namespace gmsim::engine
