// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "check/checked_rule.h"
#include "check/involution_words.h"

namespace gmsim::check {

/// Where a link leads from a node: for every row r of the match, from the node's dart in row r to
/// the dart of `node` in row r * rows. An explicit arc has the empty word, a label entry at
/// position p leads to the same node and the word p.
struct LinkTarget {
  NodeIndex node = 0;
  Word rows;
  bool operator==(const LinkTarget&) const = default;
};
using NodeLinks = std::array<std::optional<LinkTarget>, types::kMaxDimension + 1>;

/// The links that a pattern writes down, node by node: label entries and arcs. Wants a pattern that
/// passed C1 to C6.
[[nodiscard]] std::vector<NodeLinks> written_links(const Pattern& pattern);

/// A place where the links of a pattern lead to two different nodes at once, so that it matches
/// nowhere: from `from`, link `dimension` is written to `written` and follows to be `implied`.
struct Contradiction {
  NodeIndex from = 0;
  int dimension = 0;
  NodeIndex written = 0;
  NodeIndex implied = 0;
};

/// What is known about the links around a match of `left` in any map: those it writes and those
/// that follow from them by alpha_i alpha_j = alpha_j alpha_i (docs/theory.md, "links that
/// follow").
///
/// Nodes 0 .. left_count()-1 are those of `left`. Later numbers are corners: darts that are not
/// matched but close a square two of whose links are known.
class KnownLinks {
 public:
  enum class Deduce {
    Nothing,  ///< only what is written, and which label positions commute
    All
  };
  KnownLinks(const Pattern& left, int dimension, Deduce deduce = Deduce::All);

  [[nodiscard]] int dimension() const { return dimension_; }
  [[nodiscard]] NodeIndex left_count() const { return left_count_; }
  [[nodiscard]] NodeIndex node_count() const { return static_cast<NodeIndex>(links_.size()); }
  [[nodiscard]] bool is_corner(NodeIndex node) const { return node >= left_count_; }
  [[nodiscard]] const std::optional<LinkTarget>& link(NodeIndex node, int dimension) const {
    return links_[node][dimension];
  }
  [[nodiscard]] bool written(NodeIndex node, int dimension) const {
    return node < left_count_ && written_[node][dimension].has_value();
  }
  /// What moves one row to another: a generator for each label position.
  [[nodiscard]] const InvolutionGroup& rows() const { return rows_; }
  [[nodiscard]] const std::optional<Contradiction>& contradiction() const { return contradiction_; }

 private:
  void commute_labels(const Pattern& left);
  void deduce();
  void close_squares(NodeIndex v);
  void learn(NodeIndex from, int i, LinkTarget target);
  void learn_rows(const Word& identity);
  void add_link(NodeIndex from, int i, LinkTarget target);
  bool add_corner(NodeIndex v);
  void look_again(NodeIndex node);

  int dimension_;
  NodeIndex left_count_;
  std::vector<NodeLinks> written_;
  std::vector<NodeLinks> links_;
  InvolutionGroup rows_;
  std::optional<Contradiction> contradiction_;
  // Nodes around which something new is known: squares to close, then corners to name.
  std::vector<NodeIndex> squares_, corners_;
};

}  // namespace gmsim::check
