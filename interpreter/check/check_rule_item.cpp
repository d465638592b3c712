// SPDX-License-Identifier: MIT
// Rules: two patterns, conditions, parameters and assignments.
#include <algorithm>
#include <map>
#include <utility>

#include "check/build_pattern.h"
#include "check/check_expr.h"
#include "check/item_checks.h"
#include "check/passes.h"
#include "check/statements.h"
#include "support/suggest.h"

namespace gmsim::check {
using support::DiagnosticKind;
namespace {

class RuleItemChecker {
 public:
  RuleItemChecker(ItemContext& context, const syntax::RuleItem& item)
      : context_(context), item_(item) {}

  Rule run() {
    check_statement_kinds(context_, item_.body, "a rule",
                          {"dimension", "left", "right", "where", "param", "let", "assignment"});
    build_left();
    build_right();
    find_hooks();
    if (context_.good())
      for (const syntax::Statement& statement : item_.body) add(statement);
    return std::move(rule_);
  }

 private:
  void build_left() {
    const auto* left = find_side(item_.body, syntax::SideKind::Left);
    if (!left) {
      context_.report({.kind = DiagnosticKind::BadItem,
                       .message = "rule `" + item_.name.text + "` has no `left`",
                       .place = item_.name.span,
                       .help = "a rule that only creates has `left { }`"});
      return;
    }
    PatternBuilder builder(context_, syntax::SideKind::Left);
    builder.add(left->block);
    rule_.left = builder.take();
    declare_nodes(context_, rule_.left);
  }

  void build_right() {
    const auto* right = find_side(item_.body, syntax::SideKind::Right);
    rule_.has_right = right != nullptr;
    if (right) {
      PatternBuilder builder(context_, syntax::SideKind::Right);
      builder.add(right->block);
      rule_.right = builder.take();
      for (NodeIndex i = 0; i < rule_.right.nodes.size(); ++i)
        match_left(rule_.right.nodes[i], builder.has_label(i));
    } else {
      rule_.right = rule_.left;
    }
    for (const PatternNode& node : rule_.right.nodes)
      rule_.right_to_left.push_back(rule_.left.find(node.name));
    for (const PatternNode& node : rule_.left.nodes)
      rule_.left_to_right.push_back(rule_.right.find(node.name));
  }

  /// A kept node has the slot of the left and, unless another is written, its label.
  void match_left(PatternNode& node, bool has_label) {
    if (const auto left = rule_.left.find(node.name)) {
      node.slot = rule_.left.nodes[*left].slot;
      if (!has_label) node.label = rule_.left.nodes[*left].label;
      return;
    }
    context_.declare({.name = node.name, .kind = Binding::Kind::NewNode, .value = nullptr,
                      .span = node.span});
  }

  void find_hooks() {
    for (const syntax::Name& hook : item_.hooks) {
      const auto node = rule_.left.find(hook.text);
      if (!node) {
        std::vector<std::string> names;
        for (const PatternNode& known : rule_.left.nodes) names.push_back(known.name);
        if (context_.good())
          context_.report({.kind = DiagnosticKind::UnknownName,
                           .message = "`left` has no node `" + hook.text + "`",
                           .place = hook.span,
                           .help = support::did_you_mean(hook.text, names)});
        continue;
      }
      if (std::ranges::count(rule_.hooks, *node) > 0) {
        context_.report({.kind = DiagnosticKind::DuplicateNode,
                         .message = "node `" + hook.text + "` is a hook already",
                         .place = hook.span});
        continue;
      }
      rule_.hooks.push_back(*node);
    }
  }

  void add(const syntax::Statement& statement) {
    if (context_.absence) return;
    ExprChecker checker(context_);
    if (const auto* where = std::get_if<syntax::WhereStatement>(&statement.node))
      rule_.steps.push_back(
          {Step::Kind::Where, {}, checker.check_condition(where->condition, "`where`")});
    if (const auto* let = std::get_if<syntax::LetStatement>(&statement.node))
      if (auto step = checker.check_let(*let, statement.span, true)) rule_.steps.push_back(*step);
    if (const auto* param = std::get_if<syntax::ParamStatement>(&statement.node)) {
      reject_behaviour(context_, *param);
      rule_.parameters.push_back(check_parameter(context_, *param, rule_.steps));
    }
    if (const auto* assign = std::get_if<syntax::AssignStatement>(&statement.node))
      add_assignment(*assign, statement.span);
  }

  void bad_target(Span place, std::string message, std::string help) {
    context_.report({.kind = DiagnosticKind::BadAssignment, .message = std::move(message),
                     .place = place, .help = std::move(help)});
  }

  void add_assignment(const syntax::AssignStatement& assign, Span span) {
    ExprChecker checker(context_);
    if (!assign.target) return;
    const auto* member = std::get_if<syntax::MemberExpr>(&assign.target->node);
    const syntax::Expr* object = member ? member->object.get() : nullptr;
    const auto* owner = object ? std::get_if<syntax::MemberExpr>(&object->node) : nullptr;
    const bool of_interaction = owner && checker.names_interaction(owner->member.text);
    if (of_interaction) object = owner->object.get();
    const auto* name = object ? std::get_if<syntax::NameExpr>(&object->node) : nullptr;
    if (!name) {
      const bool component = owner && !of_interaction;
      bad_target(assign.target->span, "a rule assigns to an embedding of one of its nodes",
                 component ? "assign the whole of `" + owner->member.text + "`"
                           : "write `node.embedding = …`");
      return;
    }
    const auto node = find_target(name->name);
    const auto embedding = of_interaction ? checker.find_member(owner->member, member->member)
                                          : find_embedding(checker, member->member);
    if (!node || !embedding) return;
    const gmap::EmbeddingDecl& declaration = context_.env.library->schema[*embedding];
    if (!can_assign(declaration, of_interaction ? owner->member : member->member,
                    member->member.span))
      return;
    const ExprPtr value = checker.check_as(
        assign.value, {.type = declaration.type, .unit = declaration.unit,
                       .scale = declaration.unit_scale, .what = "`" + declaration.name + "`"});
    rule_.assignments.push_back(
        {.node = *node, .embedding = *embedding, .value = value,
         .target_span = assign.target->span, .span = span});
  }

  std::optional<NodeIndex> find_target(const syntax::Name& name) {
    if (const auto node = rule_.right.find(name.text)) return node;
    std::vector<std::string> names;
    for (const PatternNode& node : rule_.right.nodes) names.push_back(node.name);
    if (const auto left = rule_.left.find(name.text)) {
      context_.report({.kind = DiagnosticKind::BadAssignment,
                       .message = "node `" + name.text + "` is removed by the rule",
                       .place = name.span,
                       .related = {{rule_.left.nodes[*left].span, "only in `left`"}}});
      return std::nullopt;
    }
    bad_target(name.span, "the rule has no node `" + name.text + "`",
               support::did_you_mean(name.text, names));
    return std::nullopt;
  }

  std::optional<EmbeddingId> find_embedding(ExprChecker& checker, const syntax::Name& name) {
    if (checker.names_interaction(name.text)) {
      bad_target(name.span, "`" + name.text + "` is an interaction, not a value",
                 "assign one of its parameters, as in `a." + name.text + ".rest = …`");
      return std::nullopt;
    }
    return checker.find_value(name);
  }

  bool can_assign(const gmap::EmbeddingDecl& value, const syntax::Name& owner, Span place) {
    if (value.kind == gmap::EmbeddingKind::Derived) {
      const bool result = value.role == gmap::EmbeddingRole::Result;
      context_.report({.kind = DiagnosticKind::BadAssignment,
                       .message = result ? "`" + value.name + "` is a result of `" + owner.text +
                                               "`, which computes it"
                                         : "`" + value.name + "` is derived from other values",
                       .place = place,
                       .related = {{value.span, "declared here"}},
                       .help = "assign what it is computed from"});
      return false;
    }
    return true;
  }

  ItemContext& context_;
  const syntax::RuleItem& item_;
  Rule rule_;
};

/// Positions of the files whose embeddings concern a rule: its own, those it imports, and the basics.
std::vector<bool> files_in_view(const LoadedRules& files, std::size_t own) {
  std::vector<bool> view(files.info.size(), false);
  std::vector<std::size_t> open = {own};
  for (std::size_t i = 0; i < files.info.size(); ++i)
    if (files.info[i].basics) open.push_back(i);
  while (!open.empty()) {
    const std::size_t at = open.back();
    open.pop_back();
    if (view[at]) continue;
    view[at] = true;
    for (const std::size_t import : files.info[at].imports) open.push_back(import);
  }
  return view;
}

}  // namespace

Rule check_rule(ItemContext& context, const ItemEntry& entry) {
  Rule rule =
      RuleItemChecker(context, std::get<syntax::RuleItem>(entry.item->node)).run();
  fill_head(rule, context, entry);
  return rule;
}

void check_rule_embeddings(const Rule& rule, const ItemEntry& entry, const LoadedRules& files,
                           const gmap::EmbeddingSchema& schema,
                           support::Diagnostics& diagnostics) {
  const std::vector<bool> view = files_in_view(files, entry.file);
  std::map<support::FileId, bool> in_view;
  for (std::size_t i = 0; i < files.info.size(); ++i) in_view[files.info[i].file] = view[i];
  gmap::EmbeddingSchema concerned = schema;
  const Footprint touched = footprint(rule);
  for (std::size_t i = 0; i < concerned.size(); ++i) {
    const EmbeddingId id{static_cast<std::uint32_t>(i)};
    if (in_view[concerned[id].span.file] || std::ranges::count(touched.writes, id) > 0) continue;
    // A derived value needs nothing from a rule.
    concerned[id].kind = gmap::EmbeddingKind::Derived;
  }
  check_embeddings(rule, concerned, diagnostics);
}

}  // namespace gmsim::check
