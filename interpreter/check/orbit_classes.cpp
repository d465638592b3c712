// SPDX-License-Identifier: MIT
#include "check/orbit_classes.h"

#include <algorithm>
#include <numeric>

namespace gmsim::check {

OrbitClasses::OrbitClasses(NodeIndex nodes) : class_of_(nodes), joined_(nodes, 0) {
  std::iota(class_of_.begin(), class_of_.end(), NodeIndex{0});
}

NodeIndex OrbitClasses::root(NodeIndex node) {
  while (class_of_[node] != node) node = class_of_[node] = class_of_[class_of_[node]];
  return node;
}

void OrbitClasses::join(NodeIndex a, NodeIndex b, const Word& rows) {
  const NodeIndex u = std::min(root(a), root(b)), v = std::max(root(a), root(b));
  class_of_[v] = u;
  joined_[u] |= joined_[v];
  for (const std::uint8_t position : rows) joined_[u] |= Positions{1} << position;
}

void OrbitClasses::finish() {
  for (NodeIndex node = 0; node < class_of_.size(); ++node) class_of_[node] = root(node);
}

OrbitClasses OrbitClasses::before(const Pattern& left, const KnownLinks& links,
                                  types::OrbitType type) {
  OrbitClasses classes(links.node_count());
  for (NodeIndex node = 0; node < links.node_count(); ++node)
    for (int i = 0; i <= links.dimension(); ++i)
      if (const std::optional<LinkTarget>& to = links.link(node, i); to && type.contains(i))
        classes.join(node, to->node, links.rows().normal(to->rows));
  for (const PatternPath& path : left.paths)
    if (std::all_of(path.dimensions.begin(), path.dimensions.end(),
                    [&](int i) { return type.contains(i); }))
      classes.join(path.from, path.to, {});
  classes.finish();
  return classes;
}

OrbitClasses OrbitClasses::after(const NewLinks& links, const KnownLinks& old_links,
                                 types::OrbitType type) {
  OrbitClasses classes(links.node_count());
  for (NodeIndex node = 0; node < links.node_count(); ++node)
    for (int i = 0; i <= old_links.dimension(); ++i)
      if (const std::optional<LinkTarget> to = links.link(node, i); to && type.contains(i))
        classes.join(node, to->node, to->rows);
  classes.finish();
  return classes;
}

}  // namespace gmsim::check
