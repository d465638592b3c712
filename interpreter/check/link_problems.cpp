// SPDX-License-Identifier: MIT
#include "check/link_problems.h"

namespace gmsim::check {
namespace {

using Kind = LinkProblem::Kind;

class LinkChecker {
 public:
  LinkChecker(const Rule& rule, const KnownLinks& known)
      : rule_(rule), known_(known), new_(rule, known) {}

  std::vector<LinkProblem> run() {
    for (NodeIndex node = 0; node < rule_.left.nodes.size(); ++node)
      if (!rule_.left_to_right[node]) check_removed(node);
    for (NodeIndex node = 0; node < rule_.right.nodes.size(); ++node)
      rule_.right_to_left[node] ? check_kept(node) : check_created(node);
    if (!problems_.empty()) return std::move(problems_);
    for (NodeIndex node = 0; node < rule_.right.nodes.size(); ++node)
      for (int i = 0; i <= known_.dimension(); ++i)
        for (int j = i + 2; j <= known_.dimension(); ++j)
          if (!closed(node, i, j)) problems_.push_back({Kind::Cycle, false, node, i, j});
    return std::move(problems_);
  }

 private:
  /// The link of a left node stays what it was: it is not in `right`, and the node is kept.
  bool stays(NodeIndex left, int i) const {
    const std::optional<NodeIndex>& kept = rule_.left_to_right[left];
    return kept && !new_.written(*kept, i);
  }

  void check_removed(NodeIndex node) {
    for (int i = 0; i <= known_.dimension(); ++i) {
      const std::optional<LinkTarget>& link = known_.link(node, i);
      if (!link || known_.is_corner(link->node))
        problems_.push_back({Kind::Open, true, node, i, 0});
      else if (!known_.written(node, i) && stays(link->node, i))
        problems_.push_back({Kind::OneSided, true, node, i, 0});
    }
  }

  void check_created(NodeIndex node) {
    for (int i = 0; i <= known_.dimension(); ++i)
      if (!new_.written(node, i)) problems_.push_back({Kind::Open, false, node, i, 0});
  }

  void check_kept(NodeIndex node) {
    const NodeIndex before = *rule_.right_to_left[node];
    for (int i = 0; i <= known_.dimension(); ++i) {
      const bool in_left = known_.written(before, i), in_right = new_.written(node, i);
      if (in_left && !in_right) problems_.push_back({Kind::Lost, false, node, i, 0});
      if (in_left || !in_right) continue;
      const std::optional<LinkTarget>& link = known_.link(before, i);
      if (!link || known_.is_corner(link->node))
        problems_.push_back({Kind::Gained, false, node, i, 0});
      else if (stays(link->node, i))
        problems_.push_back({Kind::OneSided, false, node, i, 0});
    }
  }

  /// C8: alpha_j alpha_i = alpha_i alpha_j at the node's darts after the rewrite.
  bool closed(NodeIndex node, int i, int j) const {
    // A dart that keeps both links keeps its square: each neighbour either keeps its links too or
    // has a closed square of its own, which then is this one.
    if (new_.unchanged(node, i) && new_.unchanged(node, j)) return true;
    const std::optional<LinkTarget> by_i = new_.link(node, i), by_j = new_.link(node, j);
    if (!by_i || !by_j) return false;
    const std::optional<LinkTarget> by_ij = new_.link(by_i->node, j);
    const std::optional<LinkTarget> by_ji = new_.link(by_j->node, i);
    return by_ij && by_ji && by_ij->node == by_ji->node &&
           known_.rows().product(by_i->rows, by_ij->rows) ==
               known_.rows().product(by_j->rows, by_ji->rows);
  }

  const Rule& rule_;
  const KnownLinks& known_;
  NewLinks new_;
  std::vector<LinkProblem> problems_;
};

}  // namespace

std::vector<LinkProblem> link_problems(const Rule& rule, const KnownLinks& known) {
  return LinkChecker(rule, known).run();
}

}  // namespace gmsim::check
