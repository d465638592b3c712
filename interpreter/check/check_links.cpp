// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "check/link_problems.h"

namespace gmsim::check {
namespace {

using support::Diagnostic;
using support::DiagnosticKind;
using Kind = LinkProblem::Kind;

/// Where a side writes a link of a node: the arc or the label.
std::optional<Span> link_span(const Pattern& side, NodeIndex node, int dimension) {
  for (const PatternArc& arc : side.arcs)
    if (arc.dimension == dimension && (arc.a == node || arc.b == node)) return arc.span;
  for (const LabelEntry entry : side.nodes[node].label)
    if (entry == dimension) return side.nodes[node].label_span;
  return std::nullopt;
}

/// The other end of an arc of a node, if the link is written as one.
std::optional<NodeIndex> arc_end(const Pattern& side, NodeIndex node, int dimension) {
  for (const PatternArc& arc : side.arcs) {
    if (arc.dimension != dimension) continue;
    if (arc.a == node) return arc.b;
    if (arc.b == node) return arc.a;
  }
  return std::nullopt;
}

std::string arc_text(const std::string& a, int dimension, const std::string& b) {
  return fmt::format("`{} -{}- {}`", a, dimension, b);
}

/// "1-link", "0- and 2-links", "0-, 1- and 2-links".
std::string links_text(const std::vector<int>& dimensions) {
  std::string text;
  for (std::size_t k = 0; k < dimensions.size(); ++k) {
    if (k > 0) text += k + 1 == dimensions.size() ? " and " : ", ";
    text += fmt::format("{}-", dimensions[k]);
  }
  return text + (dimensions.size() == 1 ? "link" : "links");
}

class LinkReport {
 public:
  LinkReport(const Rule& rule, const KnownLinks& known, std::set<std::string>& reported,
             support::Diagnostics& diagnostics)
      : rule_(rule), known_(known), reported_(reported), diagnostics_(diagnostics) {}

  void report(const std::vector<LinkProblem>& problems) {
    for (std::size_t k = 0; k < problems.size(); ++k) {
      const LinkProblem& problem = problems[k];
      if (reported_.contains(name(problem))) continue;
      reported_.insert(name(problem));
      switch (problem.kind) {
        case Kind::Lost:
          lost(problem);
          break;
        case Kind::Gained:
          gained(problem);
          break;
        case Kind::Open:
          open(problem, missing(problems, k));
          break;
        case Kind::OneSided:
          one_sided(problem);
          break;
        case Kind::Cycle:
          cycle(problem);
          break;
      }
    }
  }

  void warn(const std::vector<UnwrittenLink>& links) {
    if (links.empty()) return;
    std::string both, left_only;
    for (const UnwrittenLink& link : links) {
      std::string& list = stays(link) ? both : left_only;
      list += (list.empty() ? "" : ", ") + written_form(link);
    }
    Diagnostic warning{DiagnosticKind::ImpliedLink,
                       "the rule is sound only through links that follow from those it writes",
                       rule_.left.nodes[links.front().a].span};
    warning.severity = support::Severity::Warning;
    warning.help = "write ";
    if (!both.empty()) warning.help += both + " in `left` and `right`";
    if (!both.empty() && !left_only.empty()) warning.help += ", and ";
    if (!left_only.empty()) warning.help += left_only + " in `left`";
    diagnostics_.report(std::move(warning));
  }

 private:
  const Pattern& side(const LinkProblem& problem) const {
    return problem.in_left ? rule_.left : rule_.right;
  }
  const std::string& name(const LinkProblem& problem) const {
    return side(problem).nodes[problem.node].name;
  }
  Span place(const LinkProblem& problem) const { return side(problem).nodes[problem.node].span; }
  NodeIndex left_of(const LinkProblem& problem) const { return *rule_.right_to_left[problem.node]; }

  void lost(const LinkProblem& problem) {
    const std::string& a = name(problem);
    const int i = problem.dimension;
    const NodeIndex before = left_of(problem);
    Diagnostic error{DiagnosticKind::IncidentArcs,
                     fmt::format("node `{}` has a {}-link in `left` and none in `right`", a, i),
                     place(problem)};
    if (const std::optional<Span> span = link_span(rule_.left, before, i))
      error.related.push_back({*span, fmt::format("{}-link of `{}`", i, a)});
    const std::optional<NodeIndex> end = arc_end(rule_.left, before, i);
    if (!end) {
      error.help =
          fmt::format("keep {} in the label of `{}`, or write its {}-link in `right`", i, a, i);
    } else if (*end == before) {
      error.help = fmt::format("keep {}", arc_text(a, i, a));
    } else {
      error.help = fmt::format("write {} to leave `{}` {}-free, or keep {}", arc_text(a, i, a), a,
                               i, arc_text(rule_.left.nodes[*end].name, i, a));
      drop_other_end(*end, i);
    }
    diagnostics_.report(std::move(error));
  }

  /// An arc dropped at both its ends is one mistake.
  void drop_other_end(NodeIndex end, int i) {
    const std::optional<NodeIndex>& kept = rule_.left_to_right[end];
    if (kept && !link_span(rule_.right, *kept, i)) reported_.insert(rule_.left.nodes[end].name);
  }

  void gained(const LinkProblem& problem) {
    const std::string& a = name(problem);
    const int i = problem.dimension;
    Diagnostic error{DiagnosticKind::IncidentArcs,
                     fmt::format("node `{}` has a {}-link in `right` and none in `left`", a, i),
                     link_span(rule_.right, problem.node, i).value_or(place(problem))};
    error.related.push_back(
        {rule_.left.nodes[left_of(problem)].span, fmt::format("`{}` before", a)});
    error.help = fmt::format("say in `left` where the link led before: {} if `{}` was {}-free",
                             arc_text(a, i, a), a, i);
    diagnostics_.report(std::move(error));
  }

  std::vector<int> missing(const std::vector<LinkProblem>& problems, std::size_t first) const {
    std::vector<int> dimensions;
    for (std::size_t k = first; k < problems.size(); ++k)
      if (problems[k].kind == Kind::Open && problems[k].in_left == problems[first].in_left &&
          problems[k].node == problems[first].node)
        dimensions.push_back(problems[k].dimension);
    return dimensions;
  }

  void open(const LinkProblem& problem, const std::vector<int>& dimensions) {
    const std::string& a = name(problem);
    const std::string links = links_text(dimensions), loop = arc_text(a, dimensions[0], a);
    Diagnostic error{DiagnosticKind::IncidentArcs, {}, place(problem)};
    if (problem.in_left) {
      error.message = fmt::format("node `{}` is removed, but not its {}", a, links);
      error.help = fmt::format("match the darts at the other end in `left` ({} if `{}` is {}-free)",
                               loop, a, dimensions[0]);
    } else {
      error.message = fmt::format("node `{}` is created without its {}", a, links);
      error.help = fmt::format("write {} to leave `{}` {}-free", loop, a, dimensions[0]);
    }
    diagnostics_.report(std::move(error));
  }

  void one_sided(const LinkProblem& problem) {
    const int i = problem.dimension;
    const NodeIndex before = problem.in_left ? problem.node : left_of(problem);
    const std::string& a = name(problem);
    const std::string& b = rule_.left.nodes[known_.link(before, i)->node].name;
    Diagnostic error{DiagnosticKind::IncidentArcs,
                     fmt::format("the {}-link of `{}` leads to `{}`, which keeps it while `{}` {}",
                                 i, a, b, a, problem.in_left ? "is removed" : "changes it"),
                     problem.in_left
                         ? place(problem)
                         : link_span(rule_.right, problem.node, i).value_or(place(problem))};
    error.notes.push_back(
        fmt::format("that {} holds follows from the other links of `left`", arc_text(a, i, b)));
    error.help = fmt::format("write {} in `left` and the new {}-link of `{}` in `right`",
                             arc_text(a, i, b), i, b);
    diagnostics_.report(std::move(error));
  }

  void cycle(const LinkProblem& problem) {
    const NewLinks links(rule_, known_);
    const int i = problem.dimension, j = problem.other;
    const std::string& a = name(problem);
    mark_square(links, problem);
    for (const auto& [changed, kept] : {std::pair{i, j}, std::pair{j, i}})
      if (!links.unchanged(problem.node, changed) && !links.written(problem.node, kept))
        return unmatched_neighbour(problem, changed, kept);
    Diagnostic error{
        DiagnosticKind::BrokenCycle,
        fmt::format("links {} and {} of node `{}` no longer commute after the rule", i, j, a),
        place(problem)};
    for (const int k : {i, j})
      if (const std::optional<Span> span = link_span(rule_.right, problem.node, k))
        error.related.push_back({*span, fmt::format("{}-link of `{}`", k, a)});
    error.notes.push_back(fmt::format("over {} then {} it leads to {}, over {} then {} to {}", i, j,
                                      far_end(links, problem.node, i, j), j, i,
                                      far_end(links, problem.node, j, i)));
    error.help = fmt::format("every square of links {} and {} has to close in `right`", i, j);
    diagnostics_.report(std::move(error));
  }

  /// A changed link whose neighbour over a commuting link is not part of the match.
  void unmatched_neighbour(const LinkProblem& problem, int changed, int kept) {
    const std::string& a = name(problem);
    Diagnostic error{
        DiagnosticKind::BrokenCycle,
        fmt::format("the rule changes the {}-link of node `{}` but not that of its {}-neighbour",
                    changed, a, kept),
        link_span(rule_.right, problem.node, changed).value_or(place(problem))};
    error.notes.push_back(
        fmt::format("in a map, links {} and {} commute: two darts joined by {} have their {}-links "
                    "changed together",
                    std::min(changed, kept), std::max(changed, kept), kept, changed));
    error.help = fmt::format(
        "match the {}-link of `{}` too: in its label, or with a node of its own", kept, a);
    diagnostics_.report(std::move(error));
  }

  /// The nodes of one broken square are one mistake.
  void mark_square(const NewLinks& links, const LinkProblem& problem) {
    for (const int k : {problem.dimension, problem.other}) {
      const std::optional<LinkTarget> next = links.link(problem.node, k);
      if (next && next->node < links.right_count())
        reported_.insert(rule_.right.nodes[next->node].name);
    }
  }

  std::string far_end(const NewLinks& links, NodeIndex node, int first, int second) const {
    const std::optional<LinkTarget> near = links.link(node, first);
    const std::optional<LinkTarget> far = near ? links.link(near->node, second) : std::nullopt;
    if (!far || far->node >= links.right_count()) return "a dart outside of the match";
    const Word rows = known_.rows().product(near->rows, far->rows);
    const std::string& end = rule_.right.nodes[far->node].name;
    return rows.empty() ? fmt::format("`{}`", end)
                        : fmt::format("`{}` in another row of the match", end);
  }

  bool stays(const UnwrittenLink& link) const {
    const std::optional<NodeIndex>& kept = rule_.left_to_right[link.a];
    return kept && !link_span(rule_.right, *kept, link.dimension);
  }
  std::string written_form(const UnwrittenLink& link) const {
    const std::string& a = rule_.left.nodes[link.a].name;
    if (!link.position) return arc_text(a, link.dimension, rule_.left.nodes[link.b].name);
    std::string label;
    for (std::size_t p = 0; p < rule_.left.nodes[link.a].label.size(); ++p) {
      const LabelEntry entry = rule_.left.nodes[link.a].label[p];
      const bool here = p == *link.position;
      label += p == 0 ? "" : ",";
      label += here              ? std::to_string(link.dimension)
               : entry == kBlank ? "_"
                                 : std::to_string(static_cast<int>(entry));
    }
    return fmt::format("`{}<{}>`", a, label);
  }

  const Rule& rule_;
  const KnownLinks& known_;
  std::set<std::string>& reported_;
  support::Diagnostics& diagnostics_;
};

}  // namespace

bool check_links(const Rule& rule, std::set<std::string>& reported,
                 support::Diagnostics& diagnostics) {
  const KnownLinks known(rule.left, rule.dimension);
  LinkReport report(rule, known, reported, diagnostics);
  if (const std::optional<Contradiction>& c = known.contradiction()) {
    const std::string& a = rule.left.nodes[c->from].name;
    diagnostics.report(
        {DiagnosticKind::Conflict,
         fmt::format("`left` matches nowhere: {} and {} both follow from its links",
                     arc_text(a, c->dimension, rule.left.nodes[c->written].name),
                     arc_text(a, c->dimension, rule.left.nodes[c->implied].name)),
         link_span(rule.left, c->from, c->dimension).value_or(rule.left.nodes[c->from].span)});
    return false;
  }
  const std::vector<LinkProblem> problems = link_problems(rule, known);
  report.report(problems);
  if (problems.empty()) report.warn(links_to_write(rule, known));
  return problems.empty();
}

}  // namespace gmsim::check
