// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>
#include <vector>

#include "check/checked_rule.h"
#include "support/diagnostic.h"

/// C1 to C6, side by side: what a pattern must be before one can speak of its links.
namespace gmsim::check {

/// The sides of a rule, or the match of another item, in the words of messages.
struct PatternSide {
  const Pattern& pattern;
  const char* where;  ///< "`left`", "`right`", "`match`"
};

class StructureChecker {
 public:
  StructureChecker(int dimension, std::set<std::string>& reported,
                   support::Diagnostics& diagnostics)
      : dimension_(dimension), reported_(reported), diagnostics_(diagnostics) {}

  /// C1: labels, links and paths name dimensions that the map has.
  bool dimensions(PatternSide side);
  /// C2: a node is there once.
  bool names(PatternSide side);
  /// C3: every label is as long as `reference`, which belongs to the node `of` (null: no label).
  bool label_lengths(PatternSide side, std::size_t reference, const PatternNode* of);
  /// C4: the labels of hooks hold no blank.
  bool hook_labels(const Pattern& left, const std::vector<NodeIndex>& hooks);
  /// C5: each connected part has exactly one hook; links and paths connect.
  bool hook_counts(PatternSide side, const std::vector<NodeIndex>& hooks);
  /// C6: no node has two links of one dimension.
  bool double_links(PatternSide side);

 private:
  /// False when the node was reported before; else it counts as reported.
  bool first_report(const PatternNode& node);

  int dimension_;
  std::set<std::string>& reported_;
  support::Diagnostics& diagnostics_;
};

}  // namespace gmsim::check
