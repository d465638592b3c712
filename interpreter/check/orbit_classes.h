// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "check/new_links.h"

namespace gmsim::check {

/// Label positions as a bit set; labels have at most n + 1 entries.
using Positions = std::uint32_t;

/// Which nodes of one side of a rule stand for darts of one orbit of some type, and which rows do:
/// a position is joined in a class when moving along it stays in the orbit (theory: "active").
class OrbitClasses {
 public:
  /// Before the rewrite, in the numbering of `left`.
  static OrbitClasses before(const Pattern& left, const KnownLinks& links, types::OrbitType type);
  /// After the rewrite, in the numbering of `right`.
  static OrbitClasses after(const NewLinks& links, const KnownLinks& old_links,
                            types::OrbitType type);

  /// The smallest node of the node's class.
  [[nodiscard]] NodeIndex of(NodeIndex node) const { return class_of_[node]; }
  [[nodiscard]] Positions joined(NodeIndex node) const { return joined_[class_of_[node]]; }

 private:
  explicit OrbitClasses(NodeIndex nodes);
  [[nodiscard]] NodeIndex root(NodeIndex node);
  void join(NodeIndex a, NodeIndex b, const Word& rows);
  void finish();

  std::vector<NodeIndex> class_of_;
  std::vector<Positions> joined_;
};

}  // namespace gmsim::check
