// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "check/item_context.h"

namespace gmsim::check {

/// Collects the nodes, arcs and paths of one side of a rule, or of the pattern of an interaction or a
/// criterion. Named patterns are expanded: a node of theirs that is no parameter gets a name that
/// cannot be written ("quad.x").
class PatternBuilder {
 public:
  PatternBuilder(ItemContext& context, syntax::SideKind side) : context_(context), side_(side) {}

  void add(const syntax::PatternBlock& block);
  /// A node that stands by itself, as the dart of an interaction without `match`.
  NodeIndex add_node(const syntax::Name& name);
  [[nodiscard]] Pattern take() { return std::move(pattern_); }
  /// Whether a label was written for the node (an empty label can also mean that none was).
  [[nodiscard]] bool has_label(NodeIndex node) const { return has_label_[node]; }

 private:
  /// Names inside of a pattern being expanded -> nodes outside.
  struct Substitution {
    std::map<std::string, syntax::Name> nodes;
    std::string prefix;
    Span use;
  };
  void add(const syntax::PatternBlock& block, Substitution* inside);
  void add_chain(const syntax::Chain& chain, Substitution* inside);
  void add_use(const syntax::PatternUse& use, Span span, Substitution* inside);
  bool check_arguments(const syntax::PatternUse& use, const syntax::PatternItem& pattern,
                       Span place, Substitution* inside);
  void add_link(const syntax::Link& link, NodeIndex from, NodeIndex to, Substitution* inside);
  void set_label(NodeIndex node, const syntax::OrbitExpr& label, Substitution* inside);
  NodeIndex node(const syntax::Name& name);
  static const syntax::Name& outer_name(const syntax::Name& name, Substitution* inside);

  ItemContext& context_;
  syntax::SideKind side_;
  Pattern pattern_;
  std::vector<bool> has_label_;
  std::vector<ItemIndex> expanding_;
  std::map<std::string, int> uses_;
};

/// Checks the body of a named pattern by itself.
void check_pattern(Environment& environment, ItemIndex pattern,
                   const support::SourceMap& sources);

}  // namespace gmsim::check
