// SPDX-License-Identifier: MIT
#include "check/build_pattern.h"

#include <algorithm>
#include <utility>

#include "check/resolve.h"
#include "support/suggest.h"

namespace gmsim::check {
using support::DiagnosticKind;
namespace {

/// Nodes of one pattern: far above any real one, and a bound for nested uses.
constexpr std::size_t kMostNodes = 512;
constexpr std::size_t kMostLinks = 4096;

bool same_arc(const PatternArc& a, const PatternArc& b) {
  return a.dimension == b.dimension &&
         ((a.a == b.a && a.b == b.b) || (a.a == b.b && a.b == b.a));
}

}  // namespace

void PatternBuilder::add(const syntax::PatternBlock& block) {
  pattern_.span = block.span;
  add(block, nullptr);
}

void PatternBuilder::add(const syntax::PatternBlock& block, Substitution* inside) {
  for (const syntax::PatternStatement& statement : block.statements) {
    if (context_.absence) return;
    if (const auto* chain = std::get_if<syntax::Chain>(&statement.node)) add_chain(*chain, inside);
    if (const auto* use = std::get_if<syntax::PatternUse>(&statement.node))
      add_use(*use, inside ? inside->use : statement.span, inside);
  }
}

NodeIndex PatternBuilder::add_node(const syntax::Name& name) { return node(name); }

NodeIndex PatternBuilder::node(const syntax::Name& name) {
  if (const auto known = pattern_.find(name.text)) return *known;
  if (pattern_.nodes.size() >= kMostNodes) {
    context_.report({.kind = DiagnosticKind::TooDeep,
                     .message = "a pattern holds at most " + std::to_string(kMostNodes) + " nodes",
                     .place = name.span});
    return 0;
  }
  pattern_.nodes.push_back(
      {.name = name.text, .label = {}, .slot = {}, .span = name.span, .label_span = name.span});
  has_label_.push_back(false);
  return static_cast<NodeIndex>(pattern_.nodes.size() - 1);
}

const syntax::Name& PatternBuilder::outer_name(const syntax::Name& name, Substitution* inside) {
  if (!inside) return name;
  auto [at, added] = inside->nodes.try_emplace(name.text);
  if (added) at->second = {inside->prefix + "." + name.text, inside->use};
  return at->second;
}

void PatternBuilder::add_chain(const syntax::Chain& chain, Substitution* inside) {
  std::vector<NodeIndex> nodes;
  for (const syntax::NodeMention& mention : chain.nodes) {
    nodes.push_back(node(outer_name(mention.name, inside)));
    if (mention.label) set_label(nodes.back(), *mention.label, inside);
  }
  for (std::size_t i = 0; i < chain.links.size(); ++i)
    add_link(chain.links[i], nodes[i], nodes[i + 1], inside);
}

void PatternBuilder::set_label(NodeIndex index, const syntax::OrbitExpr& label,
                               Substitution* inside) {
  const Span place = inside ? inside->use : label.span;
  PatternNode& node = pattern_.nodes[index];
  if (has_label_[index]) {
    context_.report({.kind = DiagnosticKind::DuplicateNode,
                     .message = "node `" + node.name + "` has two labels",
                     .place = place,
                     .related = {{node.label_span, "the first one"}},
                     .help = "a label stands at one mention of its node"});
    return;
  }
  auto entries = resolve_label(context_, label);
  if (!entries) return;
  node.label = std::move(*entries);
  node.label_span = place;
  has_label_[index] = true;
}

void PatternBuilder::add_link(const syntax::Link& link, NodeIndex from, NodeIndex to,
                              Substitution* inside) {
  const Span place = inside ? inside->use : link.span;
  std::vector<int> dimensions;
  for (const syntax::LinkDimension& step : link.path) {
    const auto i = resolve_link(context_, step, DiagnosticKind::LinkDimension);
    if (!i) return;
    dimensions.push_back(*i);
  }
  if (dimensions.empty() || pattern_.arcs.size() + pattern_.paths.size() >= kMostLinks) return;
  if (dimensions.size() == 1) {
    const PatternArc arc{.dimension = dimensions[0], .a = from, .b = to, .span = place};
    const bool known = std::ranges::any_of(
        pattern_.arcs, [&](const PatternArc& other) { return same_arc(arc, other); });
    if (!known) pattern_.arcs.push_back(arc);
    return;
  }
  if (side_ == syntax::SideKind::Right) {
    context_.report({.kind = DiagnosticKind::PathInRight,
                     .message = "a path of several links stands in `right`",
                     .place = place,
                     .help = "name every dart, as in `a -0- x -1- b`"});
    return;
  }
  pattern_.paths.push_back(
      {.dimensions = std::move(dimensions), .from = from, .to = to, .span = place});
}

bool PatternBuilder::check_arguments(const syntax::PatternUse& use,
                                     const syntax::PatternItem& pattern, Span place,
                                     Substitution* inside) {
  if (use.arguments.size() != pattern.parameters.size()) {
    context_.report({.kind = DiagnosticKind::ArgumentCount,
                     .message = "pattern `" + use.pattern.text + "` has " +
                                std::to_string(pattern.parameters.size()) + " nodes, this gives " +
                                std::to_string(use.arguments.size()),
                     .place = inside ? place : use.pattern.span,
                     .related = {{pattern.name.span, "declared here"}}});
    return false;
  }
  for (std::size_t i = 0; i < use.arguments.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (use.arguments[i].text == use.arguments[j].text) {
        context_.report({.kind = DiagnosticKind::DuplicateNode,
                         .message = "the nodes of a pattern are distinct darts; `" +
                                    use.arguments[i].text + "` stands twice",
                         .place = inside ? place : use.arguments[i].span});
        return false;
      }
  return true;
}

void PatternBuilder::add_use(const syntax::PatternUse& use, Span span, Substitution* inside) {
  const Span place = inside ? inside->use : use.pattern.span;
  const ItemTable& items = *context_.env.items;
  const auto item =
      items.find(NameSpace::Patterns, use.pattern.text, context_.n(), context_.in_library);
  if (!item) {
    if (const auto other = items.find_any(NameSpace::Patterns, use.pattern.text)) {
      context_.absent(DiagnosticKind::Dimension, place,
                      "pattern `" + use.pattern.text + "` says `dimension " +
                          std::to_string(*items[*other].dimension) + ";`");
      return;
    }
    context_.report_unknown({.kind = DiagnosticKind::UnknownItem,
                             .message = "no pattern named `" + use.pattern.text + "`",
                             .place = place,
                             .help = support::did_you_mean(use.pattern.text,
                                                           items.names(NameSpace::Patterns))});
    return;
  }
  const auto& pattern = std::get<syntax::PatternItem>(items[*item].item->node);
  if (std::ranges::find(expanding_, *item) != expanding_.end() ||
      context_.env.states[*item].status == ItemStatus::InProgress) {
    context_.report({.kind = DiagnosticKind::RecursiveDefinition,
                     .message = "pattern `" + use.pattern.text + "` is defined through itself",
                     .place = place,
                     .related = {{pattern.name.span, "declared here"}}});
    return;
  }
  if (context_.env.node_budget-- <= 0 || expanding_.size() >= kDeepestDefinition ||
      context_.env.states[*item].status == ItemStatus::Unchecked) {
    context_.report({.kind = DiagnosticKind::TooDeep,
                     .message = "this pattern is too large once the patterns it uses are expanded",
                     .place = place});
    context_.poison();
    return;
  }
  if (!context_.require(*item, place) || !check_arguments(use, pattern, place, inside)) return;
  Substitution substitution{.nodes = {}, .prefix = use.pattern.text, .use = span};
  if (const int count = uses_[use.pattern.text]++; count > 0)
    substitution.prefix += "#" + std::to_string(count + 1);
  for (std::size_t i = 0; i < pattern.parameters.size(); ++i) {
    const syntax::Name& argument = outer_name(use.arguments[i], inside);
    substitution.nodes[pattern.parameters[i].text] = argument;
    node(argument);
  }
  const bool user = std::exchange(context_.in_library, items[*item].library);
  expanding_.push_back(*item);
  add(pattern.block, &substitution);
  expanding_.pop_back();
  context_.in_library = user;
}

void check_pattern(Environment& env, ItemIndex item, const support::SourceMap& sources) {
  ItemState& state = env.states[item];
  if (state.status != ItemStatus::Unchecked) return;
  const auto& pattern = std::get<syntax::PatternItem>((*env.items)[item].item->node);
  const bool library = (*env.items)[item].library;
  // Patterns used inside come first, so that a mistake there is reported there.
  state.status = ItemStatus::InProgress;
  if (env.definition_depth++ < kDeepestDefinition)
    for (const syntax::PatternStatement& statement : pattern.block.statements)
      if (const auto* use = std::get_if<syntax::PatternUse>(&statement.node))
        if (const auto used =
                env.items->find(NameSpace::Patterns, use->pattern.text, env.dimension, library))
          check_pattern(env, *used, sources);
  --env.definition_depth;
  ItemContext context(env, sources);
  context.in_library = library;
  PatternBuilder builder(context, syntax::SideKind::Match);
  builder.add(pattern.block);
  const Pattern built = builder.take();
  for (std::size_t i = 0; i < pattern.parameters.size(); ++i) {
    const syntax::Name& name = pattern.parameters[i];
    for (std::size_t j = 0; j < i; ++j)
      if (pattern.parameters[j].text == name.text)
        context.report({.kind = DiagnosticKind::DuplicateName,
                        .message = "`" + name.text + "` is already a node here",
                        .place = name.span,
                        .related = {{pattern.parameters[j].span, "declared here"}}});
    if (!built.find(name.text) && context.good())
      context.report({.kind = DiagnosticKind::UnknownName,
                      .message = "the pattern does not say where node `" + name.text + "` is",
                      .place = name.span});
  }
  state.diagnostics = context.diagnostics;
  state.absence = context.absence;
  state.status = context.absence  ? ItemStatus::Absent
                 : context.good() ? ItemStatus::Present
                                  : ItemStatus::Failed;
}

}  // namespace gmsim::check
