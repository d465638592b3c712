// SPDX-License-Identifier: MIT
#include "check/known_links.h"

#include <cstdlib>

namespace gmsim::check {
namespace {

std::size_t position_count(const Pattern& pattern) {
  return pattern.nodes.empty() ? 0 : pattern.nodes.front().label.size();
}

}  // namespace

std::vector<NodeLinks> written_links(const Pattern& pattern) {
  std::vector<NodeLinks> links(pattern.nodes.size());
  for (NodeIndex node = 0; node < pattern.nodes.size(); ++node) {
    const std::vector<LabelEntry>& label = pattern.nodes[node].label;
    for (std::size_t p = 0; p < label.size(); ++p)
      if (label[p] != kBlank) links[node][label[p]] = LinkTarget{node, {static_cast<std::uint8_t>(p)}};
  }
  for (const PatternArc& arc : pattern.arcs) {
    links[arc.a][arc.dimension] = LinkTarget{arc.b, {}};
    links[arc.b][arc.dimension] = LinkTarget{arc.a, {}};
  }
  return links;
}

KnownLinks::KnownLinks(const Pattern& left, int dimension, Deduce deduce)
    : dimension_(dimension),
      left_count_(static_cast<NodeIndex>(left.nodes.size())),
      written_(written_links(left)),
      links_(written_),
      rows_(position_count(left)) {
  commute_labels(left);
  if (deduce == Deduce::Nothing) return;
  do {
    this->deduce();
  } while (!contradiction_ && add_corner());
}

/// Two generators of the rows commute when some node realises them by links that commute: rows
/// are told apart by that node's darts, since a match is injective.
void KnownLinks::commute_labels(const Pattern& left) {
  for (const PatternNode& node : left.nodes)
    for (std::uint8_t p = 0; p < node.label.size(); ++p)
      for (std::uint8_t q = 0; q < p; ++q) {
        const int i = node.label[p], j = node.label[q];
        if (i != kBlank && j != kBlank && std::abs(i - j) >= 2) rows_.learn_identity({p, q, p, q});
      }
}

void KnownLinks::deduce() {
  bool learnt = true;
  while (learnt && !contradiction_) {
    learnt = false;
    for (NodeIndex v = 0; v < node_count(); ++v)
      for (int i = 0; i <= dimension_; ++i)
        for (int j = 0; j <= dimension_; ++j)
          if (std::abs(i - j) >= 2 && close_square(v, i, j)) learnt = true;
  }
}

/// Three known sides v-i-s, s-j-u, v-j-t of a square give the fourth, t-i-u.
bool KnownLinks::close_square(NodeIndex v, int i, int j) {
  const std::optional<LinkTarget> s = links_[v][i], t = links_[v][j];
  if (contradiction_ || !s || !t || !links_[s->node][j]) return false;
  const LinkTarget u = *links_[s->node][j];
  // alpha_i(t, r t.rows) = alpha_i alpha_j(v, r) = alpha_j alpha_i(v, r) = (u, r s.rows u.rows)
  const Word along = rows_.product(s->rows, u.rows);
  return learn(t->node, i, {u.node, rows_.product(rows_.inverse(t->rows), along)});
}

bool KnownLinks::learn(NodeIndex from, int i, LinkTarget target) {
  const std::optional<LinkTarget>& known = links_[from][i];
  if (!known) {
    const std::optional<LinkTarget>& back = links_[target.node][i];
    if (!back) {
      links_[from][i] = target;
      links_[target.node][i] = LinkTarget{from, rows_.inverse(target.rows)};
      // A link of a node to itself is an involution of the rows.
      if (from == target.node && rows_.learn_identity(rows_.product(target.rows, target.rows)))
        renormalise();
      return true;
    }
    // The far end is linked elsewhere already.
    if (!is_corner(back->node) && !is_corner(from))
      contradiction_ = Contradiction{target.node, i, back->node, from};
    return false;
  }
  if (known->node != target.node) {
    if (!is_corner(known->node) && !is_corner(target.node) && !is_corner(from))
      contradiction_ = Contradiction{from, i, known->node, target.node};
    return false;
  }
  if (known->rows == target.rows || is_corner(known->node)) return false;
  // One dart in two rows: the rows are the same, which is a fact about all rows.
  if (!rows_.learn_identity(rows_.product(rows_.inverse(known->rows), target.rows))) return false;
  renormalise();
  return true;
}

/// Names the fourth dart of a square of which a matched dart knows two sides.
bool KnownLinks::add_corner() {
  for (NodeIndex v = 0; v < left_count_; ++v)
    for (int i = 0; i <= dimension_; ++i)
      for (int j = 0; j <= dimension_; ++j) {
        const std::optional<LinkTarget>&s = links_[v][i], &t = links_[v][j];
        if (std::abs(i - j) < 2 || !s || !t || links_[s->node][j]) continue;
        const NodeIndex near = s->node, corner = node_count();
        links_.emplace_back();
        links_[near][j] = LinkTarget{corner, {}};
        links_[corner][j] = LinkTarget{near, {}};
        return true;
      }
  return false;
}

void KnownLinks::renormalise() {
  for (NodeLinks& node : links_)
    for (std::optional<LinkTarget>& link : node)
      if (link) link->rows = rows_.normal(link->rows);
}

}  // namespace gmsim::check
