// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "engine/force_matches.h"
#include "engine/force_watch.h"
#include "engine/force_ways.h"

namespace gmsim::engine {

/// Which matches of an item have to be looked at again after a change of the map.
class MatchWatch {
 public:
  MatchWatch(const ForceContext& context, const compile::RootedPattern& pattern,
             const compile::ItemBody& body);

  void clear();
  /// A match that holds, or one that would if its conditions did.
  void add(const ForceMatch& match);
  /// To be called when the first matches have all been added.
  void pack() { watch_.pack(); }

  /// Does every match depend on what is watched alone? Else all have to be found anew.
  [[nodiscard]] bool complete() const { return complete_; }
  /// Appends the darts whose orbits have to be looked at after a change of these darts (as in
  /// MapDelta): keys of matches that depend on them, some of which may be gone, and darts from which a
  /// match that holds one of them would start.
  void find_stale(std::span<const DartId> changed, std::vector<DartId>& keys,
                  std::vector<DartId>& hooks) const;

 private:
  const ForceContext& context_;
  const compile::RootedPattern& pattern_;
  const compile::ItemBody& body_;
  const std::vector<Way> ways_;
  DartWatch watch_;
  bool complete_ = true;
  std::vector<DartId> darts_;  // work space
};

}  // namespace gmsim::engine
