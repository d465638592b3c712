// SPDX-License-Identifier: MIT
#include <algorithm>

#include "support/rule_mutants.h"
#include "support/scheme_text.h"

namespace gmsim::tests {
namespace {

using check::kBlank;
using check::LabelEntry;
using check::NodeIndex;
using check::Pattern;
using check::PatternArc;
using check::PatternNode;
using check::Rule;

void random_side(Pattern& side, int dimension, int first, int count, std::size_t positions,
                 Random& random) {
  for (int k = 0; k < count; ++k) {
    PatternNode node;
    node.name = std::string(1, static_cast<char>('a' + first + k));
    node.label.assign(positions, kBlank);
    side.nodes.push_back(node);
  }
  for (NodeIndex node = 0; node < side.nodes.size(); ++node)
    for (int i = 0; i <= dimension; ++i) {
      const int dice = below(random, 6);
      if (dice < 2 && positions > 0) {
        LabelEntry& entry =
            side.nodes[node]
                .label[static_cast<std::size_t>(below(random, static_cast<int>(positions)))];
        if (entry == kBlank) entry = static_cast<LabelEntry>(i);
      } else if (dice < 4) {
        const auto other = static_cast<NodeIndex>(below(random, count));
        side.arcs.push_back({i, node, dice == 2 ? node : other, {}});
      }
    }
}

/// Keeps the first mention of a dimension at a node.
void drop_double_links(Pattern& side) {
  std::vector<std::vector<int>> seen(side.nodes.size());
  const auto fresh = [&](NodeIndex node, int i) {
    if (std::count(seen[node].begin(), seen[node].end(), i) > 0) return false;
    seen[node].push_back(i);
    return true;
  };
  for (NodeIndex node = 0; node < side.nodes.size(); ++node)
    for (LabelEntry& entry : side.nodes[node].label)
      if (entry != kBlank && !fresh(node, entry)) entry = kBlank;
  std::vector<PatternArc> arcs;
  for (const PatternArc& arc : side.arcs) {
    if (!fresh(arc.a, arc.dimension)) continue;
    if (arc.b != arc.a && !fresh(arc.b, arc.dimension)) continue;
    arcs.push_back(arc);
  }
  side.arcs = std::move(arcs);
}

}  // namespace

Rule random_rule(int dimension, Random& random) {
  Rule rule;
  rule.dimension = dimension;
  const auto positions = static_cast<std::size_t>(below(random, 3));
  const int left = 1 + below(random, 3);
  random_side(rule.left, dimension, 0, left, positions, random);
  // The hook's label has no blank; the others stay near it.
  std::vector<int> dimensions;
  for (int i = 0; i <= dimension; ++i) dimensions.push_back(i);
  std::shuffle(dimensions.begin(), dimensions.end(), random);
  for (std::size_t p = 0; p < positions; ++p)
    rule.left.nodes[0].label[p] = static_cast<LabelEntry>(dimensions[p]);
  rule.hooks = {0};
  drop_double_links(rule.left);
  // `right` starts as `left` or from nothing, and gets a little more.
  if (chance(random, 0.8)) rule.right = rule.left;
  const int added = below(random, 3);
  if (added > 0 && rule.right.nodes.size() < 8)
    random_side(rule.right, dimension, static_cast<int>(rule.right.nodes.size()), added, positions,
                random);
  drop_double_links(rule.right);
  pair_nodes_by_name(rule);
  for (NodeIndex node = 0; node < rule.left.nodes.size(); ++node)
    rule.left.nodes[node].slot = types::Slot{node};
  rule.frame_size = static_cast<std::uint32_t>(rule.left.nodes.size());
  return rule;
}

}  // namespace gmsim::tests
