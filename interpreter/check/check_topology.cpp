// SPDX-License-Identifier: MIT
#include "check/check_structure.h"
#include "check/link_problems.h"
#include "check/passes.h"

namespace gmsim::check {
namespace {

/// The label whose length all others must have: the first hook's, or any when there is no hook.
const PatternNode* reference_label(const Pattern& left, const std::vector<NodeIndex>& hooks) {
  if (!hooks.empty()) return &left.nodes[hooks.front()];
  return left.nodes.empty() ? nullptr : &left.nodes.front();
}

bool no_paths(const Pattern& right, support::Diagnostics& diagnostics) {
  for (const PatternPath& path : right.paths)
    diagnostics.report(
        {support::DiagnosticKind::PathInRight,
         "a path of several links stands in `right`",
         path.span,
         {},
         {},
         "name the darts in between: every link that a rule makes has two named ends"});
  return right.paths.empty();
}

/// C1 to C6. `links`: the links of the sides can be looked at, because C1 to C3 and C6 hold.
bool check_structure(const Rule& rule, std::set<std::string>& reported, bool& links,
                     support::Diagnostics& diagnostics) {
  StructureChecker structure(rule.dimension, reported, diagnostics);
  const PatternNode* reference = reference_label(rule.left, rule.hooks);
  const std::size_t length = reference != nullptr ? reference->label.size() : 0;
  std::vector<PatternSide> sides{{rule.left, "`left`"}};
  if (rule.has_right) sides.push_back({rule.right, "`right`"});

  links = !rule.has_right || no_paths(rule.right, diagnostics);
  for (const PatternSide& side : sides) {
    links &= structure.dimensions(side);
    links &= structure.names(side);
    links &= structure.label_lengths(side, length, reference);
    links &= structure.double_links(side);
  }
  const bool rooted = structure.hook_labels(rule.left, rule.hooks) &
                      structure.hook_counts(sides.front(), rule.hooks);
  return links && rooted;
}

}  // namespace

bool check_topology(const Rule& rule, support::Diagnostics& diagnostics) {
  std::set<std::string> reported;
  bool links = false;
  const bool good = check_structure(rule, reported, links, diagnostics);
  if (!links || !rule.has_right) return good;
  return check_links(rule, reported, diagnostics) && good;
}

bool is_well_formed(const Rule& rule) {
  std::set<std::string> reported;
  bool links = false;
  support::Diagnostics unread;
  return check_structure(rule, reported, links, unread);
}

bool check_match(const Pattern& match, NodeIndex hook, int dimension,
                 support::Diagnostics& diagnostics) {
  std::set<std::string> reported;
  StructureChecker structure(dimension, reported, diagnostics);
  const PatternSide side{match, "`match`"};
  const std::vector<NodeIndex> hooks{hook};
  bool good = structure.dimensions(side);
  good &= structure.label_lengths(side, match.nodes[hook].label.size(), &match.nodes[hook]);
  good &= structure.double_links(side);
  good &= structure.hook_labels(match, hooks);
  good &= structure.hook_counts(side, hooks);
  return good;
}

}  // namespace gmsim::check
