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
      if (label[p] != kBlank)
        links[node][label[p]] = LinkTarget{node, {static_cast<std::uint8_t>(p)}};
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
  if (deduce == Deduce::All) this->deduce();
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

/// First all that follows, then one corner, and again.
void KnownLinks::deduce() {
  for (NodeIndex node = left_count_; node-- > 0;) {
    squares_.push_back(node);
    corners_.push_back(node);
  }
  while (!contradiction_ && !(squares_.empty() && corners_.empty())) {
    const bool squares = !squares_.empty();
    std::vector<NodeIndex>& todo = squares ? squares_ : corners_;
    const NodeIndex node = todo.back();
    todo.pop_back();
    if (squares) {
      close_squares(node);
    } else if (add_corner(node)) {
      corners_.push_back(node);
    }
  }
}

/// Three known sides v-i-s, s-j-u, v-j-t of a square give the fourth, t-i-u.
void KnownLinks::close_squares(NodeIndex v) {
  for (int i = 0; i <= dimension_; ++i)
    for (int j = 0; j <= dimension_; ++j) {
      const std::optional<LinkTarget> s = links_[v][i], t = links_[v][j];
      if (std::abs(i - j) < 2 || contradiction_ || !s || !t || !links_[s->node][j]) continue;
      const LinkTarget u = *links_[s->node][j];
      // alpha_i(t, r t.rows) = alpha_i alpha_j(v, r) = alpha_j alpha_i(v, r) = (u, r s.rows u.rows)
      const Word along = rows_.product(s->rows, u.rows);
      learn(t->node, i, {u.node, rows_.product(rows_.inverse(t->rows), along)});
    }
}

void KnownLinks::learn(NodeIndex from, int i, LinkTarget target) {
  const std::optional<LinkTarget>& known = links_[from][i];
  if (!known) {
    const std::optional<LinkTarget>& back = links_[target.node][i];
    if (!back) {
      add_link(from, i, std::move(target));
    } else if (!is_corner(back->node) && !is_corner(from)) {
      // The far end is linked elsewhere already.
      contradiction_ = Contradiction{target.node, i, back->node, from};
    }
  } else if (known->node != target.node) {
    if (!is_corner(known->node) && !is_corner(target.node) && !is_corner(from))
      contradiction_ = Contradiction{from, i, known->node, target.node};
  } else if (known->rows != target.rows && !is_corner(known->node)) {
    // One dart in two rows: the rows are the same, which is a fact about all rows.
    learn_rows(rows_.product(rows_.inverse(known->rows), target.rows));
  }
}

void KnownLinks::learn_rows(const Word& identity) {
  if (!rows_.learn_identity(identity)) return;
  for (NodeLinks& node : links_)
    for (std::optional<LinkTarget>& link : node)
      if (link) link->rows = rows_.normal(link->rows);
  for (NodeIndex node = 0; node < node_count(); ++node) squares_.push_back(node);
}

void KnownLinks::add_link(NodeIndex from, int i, LinkTarget target) {
  const NodeIndex to = target.node;
  const Word rows = target.rows;
  links_[from][i] = std::move(target);
  links_[to][i] = LinkTarget{from, rows_.inverse(rows)};
  look_again(from);
  look_again(to);
  // A link of a node to itself is an involution of the rows.
  if (from == to) learn_rows(rows_.product(rows, rows));
}

/// A new link of a node may be a side of the squares at the node and at its neighbours.
void KnownLinks::look_again(NodeIndex node) {
  squares_.push_back(node);
  for (int i = 0; i <= dimension_; ++i)
    if (links_[node][i]) squares_.push_back(links_[node][i]->node);
  if (!is_corner(node)) corners_.push_back(node);
}

/// Names the fourth dart of a square of which a matched dart knows two sides.
bool KnownLinks::add_corner(NodeIndex v) {
  for (int i = 0; i <= dimension_; ++i)
    for (int j = 0; j <= dimension_; ++j) {
      const std::optional<LinkTarget>&s = links_[v][i], &t = links_[v][j];
      if (std::abs(i - j) < 2 || !s || !t || links_[s->node][j]) continue;
      const NodeIndex near = s->node;
      links_.emplace_back();
      add_link(near, j, {node_count() - 1, {}});
      return true;
    }
  return false;
}

}  // namespace gmsim::check
