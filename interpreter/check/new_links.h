// SPDX-License-Identifier: MIT
#pragma once

#include "check/known_links.h"

namespace gmsim::check {

/// The links around a match after the rewrite. Nodes 0 .. right_count()-1 are those of `right`,
/// later numbers the corners of the KnownLinks this was made from.
class NewLinks {
 public:
  NewLinks(const Rule& rule, const KnownLinks& old_links);

  [[nodiscard]] NodeIndex right_count() const { return static_cast<NodeIndex>(written_.size()); }
  [[nodiscard]] NodeIndex node_count() const {
    return right_count() + (old_.node_count() - old_.left_count());
  }
  [[nodiscard]] bool written(NodeIndex node, int dimension) const {
    return node < right_count() && written_[node][dimension].has_value();
  }
  /// What `right` writes, or the link that stays as it was; empty when it leads to a dart about
  /// which nothing is known, or to a removed one.
  [[nodiscard]] std::optional<LinkTarget> link(NodeIndex node, int dimension) const;
  /// The same after `right`'s numbering: where the link of a kept node led before the rewrite.
  [[nodiscard]] std::optional<LinkTarget> old_link(NodeIndex node, int dimension) const;
  /// The link is there on both sides and leads to the same dart, or stays without being mentioned.
  [[nodiscard]] bool unchanged(NodeIndex node, int dimension) const;

 private:
  const Rule& rule_;
  const KnownLinks& old_;
  std::vector<NodeLinks> written_;
};

}  // namespace gmsim::check
