// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>
#include <vector>

#include "check/new_links.h"
#include "support/diagnostic.h"

/// C7 and C8: what becomes of the links of a rule's nodes. Deciding, wording and fixing are apart.
namespace gmsim::check {

/// A reason why a rule could break a map.
struct LinkProblem {
  enum class Kind {
    Lost,      ///< C7: a kept node has the link in `left` and none in `right`
    Gained,    ///< C7: a kept node has the link in `right`, and nothing says where it led before
    Open,      ///< C7: a removed or created node without the link
    OneSided,  ///< C7: the link stays at one end and is changed at the other, in `right` or by
               ///< removal
    Cycle      ///< C8: links `dimension` and `other` of the node may not commute any more
  };
  Kind kind = Kind::Lost;
  bool in_left = false;  ///< `node` counts nodes of `left` (a removed node)
  NodeIndex node = 0;
  int dimension = 0;
  int other = 0;
};

/// Every broken C7 and, if there is none, every broken C8, by the links that are known. With
/// KnownLinks::Deduce::All the answer is exact: no problem means that no map can break, a problem
/// that some map does (docs/theory.md).
[[nodiscard]] std::vector<LinkProblem> link_problems(const Rule& rule, const KnownLinks& known);

/// Reports C7 and C8, and warns where a rule is sound only through links that it does not write.
/// `reported` holds the names of nodes that are left out because they were reported before.
bool check_links(const Rule& rule, std::set<std::string>& reported,
                 support::Diagnostics& diagnostics);

/// A link between nodes of `left` that follows from the others and that `left` could write.
struct UnwrittenLink {
  NodeIndex a = 0;
  int dimension = 0;
  NodeIndex b = 0;
  /// Set: an entry of the label of a (then a == b); else the arc a -dimension- b.
  std::optional<std::size_t> position;
};
/// The fewest links whose writing, in `left` and where it stays in `right`, makes the rule
/// acceptable as it stands; empty when none is needed or writing does not help.
[[nodiscard]] std::vector<UnwrittenLink> links_to_write(const Rule& rule, const KnownLinks& known);

}  // namespace gmsim::check
