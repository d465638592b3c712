// SPDX-License-Identifier: MIT
#include "check/check_structure.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <string_view>

namespace gmsim::check {
namespace {

using support::Diagnostic;
using support::DiagnosticKind;

/// The connected part of each node, named by its smallest node.
std::vector<NodeIndex> connected_parts(const Pattern& pattern) {
  std::vector<NodeIndex> part(pattern.nodes.size());
  std::iota(part.begin(), part.end(), NodeIndex{0});
  const auto find = [&](NodeIndex node) {
    while (part[node] != node) node = part[node] = part[part[node]];
    return node;
  };
  const auto join = [&](NodeIndex a, NodeIndex b) {
    const NodeIndex u = find(a), v = find(b);
    part[std::max(u, v)] = std::min(u, v);
  };
  for (const PatternArc& arc : pattern.arcs) join(arc.a, arc.b);
  for (const PatternPath& path : pattern.paths) join(path.from, path.to);
  for (NodeIndex node = 0; node < part.size(); ++node) part[node] = find(node);
  return part;
}

std::string entries(std::size_t count) {
  return count == 0   ? "no label"
         : count == 1 ? "a label of 1 entry"
                      : fmt::format("a label of {} entries", count);
}

}  // namespace

bool StructureChecker::first_report(const PatternNode& node) {
  return reported_.insert(node.name).second;
}

bool StructureChecker::dimensions(PatternSide side) {
  bool good = true;
  const auto exists = [&](int i) { return i >= 0 && i <= dimension_; };
  const auto report = [&](int i, Span span, const char* what) {
    good = false;
    diagnostics_.report(
        {DiagnosticKind::LinkDimension,
         fmt::format("{} names dimension {} in a map of dimension {}", what, i, dimension_),
         span,
         {},
         {},
         fmt::format("links have dimensions 0 to {}", dimension_)});
  };
  for (const PatternNode& node : side.pattern.nodes)
    for (const LabelEntry entry : node.label)
      if (entry != kBlank && !exists(entry) && first_report(node))
        report(entry, node.label_span, "a label");
      else if (entry != kBlank && !exists(entry))
        good = false;
  for (const PatternArc& arc : side.pattern.arcs)
    if (!exists(arc.dimension)) report(arc.dimension, arc.span, "a link");
  for (const PatternPath& path : side.pattern.paths)
    for (const int i : path.dimensions)
      if (!exists(i)) report(i, path.span, "a path");
  return good;
}

bool StructureChecker::names(PatternSide side) {
  bool good = true;
  std::map<std::string_view, Span> first_places;
  for (const PatternNode& node : side.pattern.nodes) {
    const auto [first, fresh] = first_places.emplace(node.name, node.span);
    if (fresh) continue;
    good = false;
    if (first_report(node))
      diagnostics_.report({DiagnosticKind::DuplicateNode,
                           fmt::format("node `{}` stands twice in {}", node.name, side.where),
                           node.span,
                           {{first->second, "first here"}}});
  }
  return good;
}

bool StructureChecker::label_lengths(PatternSide side, std::size_t reference,
                                     const PatternNode* of) {
  bool good = true;
  for (const PatternNode& node : side.pattern.nodes) {
    if (node.label.size() == reference) continue;
    good = false;
    if (!first_report(node)) continue;
    Diagnostic error{DiagnosticKind::LabelLength, {}, node.label_span};
    if (of != nullptr) {
      error.message = fmt::format("node `{}` has {}, but `{}` has {}", node.name,
                                  entries(node.label.size()), of->name, entries(reference));
      error.related.push_back({of->label_span, fmt::format("`{}`", of->name)});
      error.help = "give every node of the rule as many entries, `_` where it has no such link";
    } else {
      error.message =
          fmt::format("node `{}` has {}, but `left` has no node whose orbit it could copy",
                      node.name, entries(node.label.size()));
      error.help = "name every created dart by a node of its own";
    }
    diagnostics_.report(std::move(error));
  }
  return good;
}

bool StructureChecker::hook_labels(const Pattern& left, const std::vector<NodeIndex>& hooks) {
  bool good = true;
  for (const NodeIndex hook : hooks) {
    const PatternNode& node = left.nodes[hook];
    if (std::count(node.label.begin(), node.label.end(), kBlank) == 0) continue;
    good = false;
    if (first_report(node))
      diagnostics_.report({DiagnosticKind::HookLabel,
                           fmt::format("the label of hook `{}` holds `_`", node.name),
                           node.label_span,
                           {},
                           {},
                           "the whole orbit is reached from the hook, so its label names a link at "
                           "every position"});
  }
  return good;
}

bool StructureChecker::hook_counts(PatternSide side, const std::vector<NodeIndex>& hooks) {
  bool good = true;
  const std::vector<NodeIndex> part = connected_parts(side.pattern);
  std::vector<std::optional<NodeIndex>> hook_of(part.size());
  for (const NodeIndex hook : hooks) {
    const PatternNode& node = side.pattern.nodes[hook];
    std::optional<NodeIndex>& first = hook_of[part[hook]];
    if (!first) {
      first = hook;
      continue;
    }
    good = false;
    if (!first_report(node)) continue;
    if (*first == hook) {
      diagnostics_.report({DiagnosticKind::DuplicateNode,
                           fmt::format("node `{}` is a hook twice", node.name), node.span});
    } else {
      const std::string& other = side.pattern.nodes[*first].name;
      diagnostics_.report({DiagnosticKind::HookCount,
                           fmt::format("hooks `{}` and `{}` stand in one connected part of {}",
                                       other, node.name, side.where),
                           node.span,
                           {{side.pattern.nodes[*first].span, "the other hook"}},
                           {},
                           fmt::format("`{}` is reached from `{}`: drop it from the parameters",
                                       node.name, other)});
    }
  }
  for (NodeIndex node = 0; node < part.size(); ++node) {
    if (part[node] != node || hook_of[node]) continue;
    good = false;
    const PatternNode& unreached = side.pattern.nodes[node];
    if (first_report(unreached))
      diagnostics_.report(
          {DiagnosticKind::HookCount,
           fmt::format("node `{}` of {} is not reached from any hook", unreached.name, side.where),
           unreached.span,
           {},
           {},
           fmt::format("link it to a node that is, or make `{}` a hook", unreached.name)});
  }
  return good;
}

bool StructureChecker::double_links(PatternSide side) {
  struct Mention {
    int dimension;
    Span span;
  };
  std::vector<std::vector<Mention>> mentions(side.pattern.nodes.size());
  bool good = true;
  const auto mention = [&](NodeIndex node, int dimension, Span span) {
    for (const Mention& first : mentions[node]) {
      if (first.dimension != dimension) continue;
      good = false;
      const PatternNode& twice = side.pattern.nodes[node];
      if (first_report(twice))
        diagnostics_.report(
            {DiagnosticKind::DuplicateDimension,
             fmt::format("node `{}` has two {}-links in {}", twice.name, dimension, side.where),
             span,
             {{first.span, fmt::format("{}-link of `{}`", dimension, twice.name)}}});
      return;
    }
    mentions[node].push_back({dimension, span});
  };
  for (NodeIndex node = 0; node < side.pattern.nodes.size(); ++node)
    for (const LabelEntry entry : side.pattern.nodes[node].label)
      if (entry != kBlank) mention(node, entry, side.pattern.nodes[node].label_span);
  for (const PatternArc& arc : side.pattern.arcs) {
    mention(arc.a, arc.dimension, arc.span);
    if (arc.b != arc.a) mention(arc.b, arc.dimension, arc.span);
  }
  return good;
}

}  // namespace gmsim::check
