// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "engine/force_matches.h"
#include "engine/force_watch.h"
#include "engine/force_ways.h"

namespace gmsim::engine {

/// A match that rests on changed darts, and on what of them.
struct StaleMatch {
  DartId key = gmap::kNoDart;
  compile::Aspects what = 0;
};

/// Which matches of an item have to be looked at again after a change of the map.
class MatchWatch {
 public:
  MatchWatch(const ForceContext& context, const compile::RootedPattern& pattern,
             const compile::ItemBody& body);

  void clear();
  /// A match that holds.
  void add(const ForceMatch& match, const ShapeInputs& inputs);
  /// One that would hold if its conditions did.
  void add_excluded(const ForceMatch& match);
  /// To be called when the first matches have all been added.
  void pack() { watch_.pack(); }

  /// Does every match depend on what is watched alone? Else all have to be found anew.
  [[nodiscard]] bool complete() const { return complete_; }
  /// Appends the matches that rest on what has changed, each once, ascending; some may be gone. And
  /// darts from which a match that was not there before would start, and darts of orbits that may be
  /// others now.
  void find_stale(std::span<const compile::Dependence> changed, std::vector<StaleMatch>& stale,
                  std::vector<DartId>& hooks, std::vector<DartId>& parts);

 private:
  void add_pattern(const ForceMatch& match);
  void add_orbit(types::OrbitType type, DartId dart, compile::Aspects what);
  void enter(DartId key);

  const ForceContext& context_;
  const compile::ItemBody& body_;
  const std::vector<PatternDart> pattern_;
  DartWatch watch_;
  bool simple_ = true;  // no conditions of the pattern
  bool complete_ = true;
  std::vector<compile::Dependence> darts_;  // work space
};

}  // namespace gmsim::engine
