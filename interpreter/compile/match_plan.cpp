// SPDX-License-Identifier: MIT
#include "compile/match_plan.h"

#include "check/checked_rule.h"
#include "compile/compile.h"
#include "support/check.h"

#include <algorithm>
#include <cstdlib>

namespace gmsim::compile {

OrbitType MatchPlan::hook_orbit() const {
  OrbitType orbit;
  if (hooks.empty()) return orbit;
  for (std::int8_t entry : nodes[hooks.front()].label) {
    if (entry != kNoEntry) orbit.insert(entry);
  }
  return orbit;
}

namespace {

using LinkKind = LinkStep::Kind;

std::vector<PlanNode> plan_nodes(const check::Pattern& pattern) {
  std::vector<PlanNode> nodes;
  for (const check::PatternNode& node : pattern.nodes) {
    nodes.push_back({node.name, node.label, node.slot, node.span});
  }
  return nodes;
}

std::vector<PlanArc> plan_arcs(const check::Pattern& pattern) {
  std::vector<PlanArc> arcs;
  for (const check::PatternArc& arc : pattern.arcs) {
    arcs.push_back({{static_cast<std::int8_t>(arc.dimension)}, arc.a, arc.b, arc.span});
  }
  for (const check::PatternPath& path : pattern.paths) {
    arcs.push_back({{path.dimensions.begin(), path.dimensions.end()}, path.from, path.to, path.span});
  }
  return arcs;
}

/// Orders the arcs so that each is checked as soon as both its ends are known.
class LinkOrder {
 public:
  explicit LinkOrder(MatchPlan& plan)
      : plan_(plan), known_(plan.nodes.size(), false), done_(plan.arcs.size(), false) {
    for (Column hook : plan.hooks) known_[hook] = true;
  }

  void run() {
    do {
      emit_checks();
    } while (emit_follow(1) || emit_follow(SIZE_MAX));
    GMSIM_CHECK(std::all_of(known_.begin(), known_.end(), [](bool k) { return k; }),
                "a node of the pattern is not connected to a hook");
  }

 private:
  void emit_checks() {
    for (std::uint32_t i = 0; i < plan_.arcs.size(); ++i) {
      const PlanArc& arc = plan_.arcs[i];
      if (done_[i] || !known_[arc.from] || !known_[arc.to]) continue;
      const bool link = arc.dimensions.size() == 1;
      emit(i, !link                  ? LinkKind::RequirePath
              : arc.from == arc.to ? LinkKind::RequireFree
                                     : LinkKind::RequireLink,
           false);
    }
  }

  /// The first arc of at most `longest` links that leads from a known node to an unknown one.
  bool emit_follow(std::size_t longest) {
    for (std::uint32_t i = 0; i < plan_.arcs.size(); ++i) {
      const PlanArc& arc = plan_.arcs[i];
      if (known_[arc.from] == known_[arc.to] || arc.dimensions.size() > longest) continue;
      const bool link = arc.dimensions.size() == 1;
      emit(i, link ? LinkKind::Follow : LinkKind::FollowPath, known_[arc.to]);
      known_[arc.from] = known_[arc.to] = true;
      return true;
    }
    return false;
  }

  void emit(std::uint32_t i, LinkKind kind, bool backwards) {
    const PlanArc& arc = plan_.arcs[i];
    LinkStep step{kind, arc.dimensions.front(), arc.from, arc.to, {}, i};
    if (kind == LinkKind::FollowPath || kind == LinkKind::RequirePath) step.path = arc.dimensions;
    if (backwards) {
      std::swap(step.from, step.to);
      std::reverse(step.path.begin(), step.path.end());
    }
    plan_.links.push_back(std::move(step));
    done_[i] = true;
  }

  MatchPlan& plan_;
  std::vector<bool> known_;
  std::vector<bool> done_;
};

/// Finds which label entries need a check. Hooks need none: their rows are made by their labels.
/// From an entry i at position p that holds at u, and a link u -j- v with |i - j| >= 2 and the same
/// entry at v, the entry of v follows: alpha_i v = alpha_i alpha_j u = alpha_j alpha_i u.
class LabelChecks {
 public:
  explicit LabelChecks(MatchPlan& plan)
      : plan_(plan), holds_(plan.nodes.size() * plan.positions, false) {}

  void run() {
    for (Column hook : plan_.hooks) {
      for (std::uint32_t p = 0; p < plan_.positions; ++p) spread(hook, p);
    }
    for (Column column = 0; column < plan_.nodes.size(); ++column) {
      for (std::uint32_t p = 0; p < plan_.positions; ++p) {
        const std::int8_t entry = plan_.nodes[column].label[p];
        if (entry == kNoEntry || holds_[column * plan_.positions + p]) continue;
        plan_.labels.push_back({column, p, entry});
        spread(column, p);
      }
    }
  }

 private:
  void spread(Column column, std::uint32_t position) {
    std::vector<Column> queue = {column};
    while (!queue.empty()) {
      const Column u = queue.back();
      queue.pop_back();
      if (holds_[u * plan_.positions + position]) continue;
      holds_[u * plan_.positions + position] = true;
      for (const PlanArc& arc : plan_.arcs) {
        if (arc.dimensions.size() != 1 || (arc.from != u && arc.to != u)) continue;
        const Column v = arc.from == u ? arc.to : arc.from;
        const std::int8_t entry = plan_.nodes[u].label[position];
        const bool commute = std::abs(entry - arc.dimensions.front()) >= 2;
        if (commute && plan_.nodes[v].label[position] == entry) queue.push_back(v);
      }
    }
  }

  MatchPlan& plan_;
  std::vector<bool> holds_;
};

}  // namespace

MatchPlan compile_pattern(const check::Pattern& pattern,
                          const std::vector<check::NodeIndex>& hooks) {
  MatchPlan plan;
  plan.nodes = plan_nodes(pattern);
  plan.arcs = plan_arcs(pattern);
  plan.hooks = hooks;
  plan.width = static_cast<std::uint32_t>(plan.nodes.size());
  if (!plan.nodes.empty()) {
    plan.positions = static_cast<std::uint32_t>(plan.nodes.front().label.size());
  }
  LinkOrder(plan).run();
  LabelChecks(plan).run();
  return plan;
}

}  // namespace gmsim::compile
