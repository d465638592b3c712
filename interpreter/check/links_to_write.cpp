// SPDX-License-Identifier: MIT
#include "check/link_problems.h"

namespace gmsim::check {
namespace {

std::vector<UnwrittenLink> writable_links(const Rule& rule, const KnownLinks& known) {
  std::vector<UnwrittenLink> links;
  for (NodeIndex a = 0; a < known.left_count(); ++a)
    for (int i = 0; i <= known.dimension(); ++i) {
      const std::optional<LinkTarget>& link = known.link(a, i);
      if (!link || known.written(a, i) || known.is_corner(link->node) || link->node < a) continue;
      if (link->rows.empty()) {
        links.push_back({a, i, link->node, std::nullopt});
      } else if (link->node == a && link->rows.size() == 1 &&
                 rule.left.nodes[a].label[link->rows[0]] == kBlank) {
        links.push_back({a, i, a, link->rows[0]});
      }
    }
  return links;
}

void write_link(Pattern& side, NodeIndex a, NodeIndex b, const UnwrittenLink& link) {
  if (!link.position) {
    side.arcs.push_back({link.dimension, a, b, side.nodes[a].span});
  } else if (side.nodes[a].label[*link.position] == kBlank) {
    side.nodes[a].label[*link.position] = static_cast<LabelEntry>(link.dimension);
  }
}

bool acceptable_with(Rule rule, const std::vector<UnwrittenLink>& links, int dimension) {
  const std::vector<NodeLinks> right = written_links(rule.right);
  for (const UnwrittenLink& link : links) {
    write_link(rule.left, link.a, link.b, link);
    const std::optional<NodeIndex> a = rule.left_to_right[link.a], b = rule.left_to_right[link.b];
    if (a && b && !right[*a][link.dimension] && !right[*b][link.dimension])
      write_link(rule.right, *a, *b, link);
  }
  const KnownLinks written(rule.left, dimension, KnownLinks::Deduce::Nothing);
  return link_problems(rule, written).empty();
}

}  // namespace

std::vector<UnwrittenLink> links_to_write(const Rule& rule, const KnownLinks& known) {
  const int dimension = known.dimension();
  if (acceptable_with(rule, {}, dimension)) return {};
  std::vector<UnwrittenLink> links = writable_links(rule, known);
  if (!acceptable_with(rule, links, dimension)) return {};
  // More than a few are all listed: finding the fewest takes time that their reader would not.
  constexpr std::size_t kMostTried = 32;
  for (std::size_t at = links.size() > kMostTried ? 0 : links.size(); at-- > 0;) {
    std::vector<UnwrittenLink> fewer = links;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(at));
    if (acceptable_with(rule, fewer, dimension)) links = std::move(fewer);
  }
  return links;
}

}  // namespace gmsim::check
