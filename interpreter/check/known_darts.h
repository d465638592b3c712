// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "check/checked_rule.h"

namespace gmsim::check {

/// The darts that a pattern speaks of, and those reached from them by links, as far as they are told
/// apart by arcs, paths and the cycle condition of generalized maps.
class KnownDarts {
 public:
  using Id = std::size_t;
  KnownDarts(const Pattern& pattern, int dimension);

  [[nodiscard]] Id of_node(NodeIndex node) const { return node; }
  /// The dart over a link, which becomes known when it was not.
  Id walk(Id dart, int link);
  /// Known darts of the orbit of a dart.
  [[nodiscard]] std::set<Id> orbit(Id dart, OrbitType type) const;
  /// Whether all darts of the orbit are known.
  [[nodiscard]] bool orbit_is_known(Id dart, OrbitType type) const;
  [[nodiscard]] bool same_vertex(Id a, Id b) const;
  [[nodiscard]] OrbitType vertex() const { return OrbitType::cell(0, dimension_); }

 private:
  using Links = std::array<std::optional<Id>, types::kMaxDimension + 1>;
  Id add();
  void link(Id a, Id b, int i);
  [[nodiscard]] std::optional<Id> across_square(Id dart, int i) const;

  int dimension_;
  std::vector<Links> darts_;
};

}  // namespace gmsim::check
