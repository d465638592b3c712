// SPDX-License-Identifier: MIT
#include "check/new_links.h"

namespace gmsim::check {

NewLinks::NewLinks(const Rule& rule, const KnownLinks& old_links)
    : rule_(rule), old_(old_links), written_(written_links(rule.right)) {
  for (NodeLinks& node : written_)
    for (std::optional<LinkTarget>& link : node)
      if (link) link->rows = old_.rows().normal(link->rows);
}

std::optional<LinkTarget> NewLinks::old_link(NodeIndex node, int dimension) const {
  const bool corner = node >= right_count();
  if (!corner && !rule_.right_to_left[node]) return std::nullopt;
  const NodeIndex before =
      corner ? node - right_count() + old_.left_count() : *rule_.right_to_left[node];
  const std::optional<LinkTarget>& link = old_.link(before, dimension);
  if (!link) return std::nullopt;
  if (old_.is_corner(link->node))
    return LinkTarget{link->node - old_.left_count() + right_count(), link->rows};
  const std::optional<NodeIndex>& kept = rule_.left_to_right[link->node];
  if (!kept) return std::nullopt;
  return LinkTarget{*kept, link->rows};
}

std::optional<LinkTarget> NewLinks::link(NodeIndex node, int dimension) const {
  if (written(node, dimension)) return written_[node][dimension];
  return old_link(node, dimension);
}

bool NewLinks::unchanged(NodeIndex node, int dimension) const {
  if (node < right_count() && !rule_.right_to_left[node]) return false;
  return !written(node, dimension) || written_[node][dimension] == old_link(node, dimension);
}

}  // namespace gmsim::check
