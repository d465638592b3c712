// SPDX-License-Identifier: MIT
#include "check/check_invariance.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace gmsim::check {
namespace {

using types::Expr;
using types::ExprKind;
using types::ExprPtr;

ExprPtr walk_one(const ExprPtr& dart, int dimension) {
  if (dart->kind == ExprKind::Alpha && dart->number == dimension) return dart->args[0];
  Expr walk{ExprKind::Alpha, {types::ValueKind::Dart}, {}, dart->span, {dart}};
  walk.number = dimension;
  return std::make_shared<Expr>(std::move(walk));
}

/// A walk from the dart of a node in one row to its dart in the row that a position leads to.
std::vector<int> walk_to_next_row(const KnownLinks& links, NodeIndex node, std::uint8_t position) {
  constexpr std::size_t kLongest = 12;
  const LinkTarget goal{node, links.rows().normal({position})};
  using Place = std::pair<NodeIndex, Word>;
  std::map<Place, std::vector<int>> walks{{{node, {}}, {}}};
  std::vector<Place> todo{{node, {}}};
  for (std::size_t next = 0; next < todo.size(); ++next) {
    const Place at = todo[next];
    if (at == Place{goal.node, goal.rows} || walks[at].size() > kLongest) return walks[at];
    for (int i = 0; i <= links.dimension(); ++i) {
      const std::optional<LinkTarget>& link = links.link(at.first, i);
      if (!link) continue;
      Place to{link->node, links.rows().product(at.second, link->rows)};
      if (to.second.size() > 1 || walks.contains(to)) continue;
      std::vector<int> walk = walks[at];
      walk.push_back(i);
      walks.emplace(to, std::move(walk));
      todo.push_back(std::move(to));
    }
  }
  return {};
}

/// Replaces locals, and shares what stays as it was.
class Substitution {
 public:
  explicit Substitution(std::map<std::uint32_t, ExprPtr> locals) : locals_(std::move(locals)) {}

  ExprPtr apply(const ExprPtr& expr) {
    if (const auto found = done_.find(expr.get()); found != done_.end()) return found->second;
    ExprPtr result = expr;
    if (expr->kind == ExprKind::Local) {
      if (const auto local = locals_.find(types::index(expr->slot)); local != locals_.end())
        result = local->second;
    } else if (!expr->args.empty()) {
      result = rebuild(expr);
    }
    done_.emplace(expr.get(), result);
    return result;
  }
  void add(types::Slot slot, ExprPtr value) {
    locals_.insert_or_assign(types::index(slot), std::move(value));
    done_.clear();
  }

 private:
  ExprPtr rebuild(const ExprPtr& expr) {
    std::vector<ExprPtr> args;
    for (const ExprPtr& arg : expr->args) args.push_back(apply(arg));
    if (args == expr->args) return expr;
    if (expr->kind == ExprKind::Alpha) return walk_one(args[0], expr->number);
    Expr changed = *expr;
    changed.args = std::move(args);
    return std::make_shared<Expr>(std::move(changed));
  }

  std::map<std::uint32_t, ExprPtr> locals_;
  std::map<const Expr*, ExprPtr> done_;
};

std::string shortened(std::string text) {
  constexpr std::size_t kLongest = 160;
  if (text.size() > kLongest) text = text.substr(0, kLongest) + "…";
  return text;
}

}  // namespace

std::string orbit_in_words(types::OrbitType type, int dimension) {
  constexpr const char* kCells[] = {"vertex", "edge", "face", "volume"};
  for (int i = 0; i <= dimension; ++i)
    if (type == types::OrbitType::cell(i, dimension)) return kCells[i];
  return type.empty() ? "dart" : "orbit " + types::to_string(type);
}

InvarianceChecker::InvarianceChecker(const Rule& rule, const KnownLinks& links,
                                     const gmap::EmbeddingSchema& schema)
    : rule_(rule), links_(links), schema_(schema), forms_(rule.left, links, schema, rule.steps) {}

bool InvarianceChecker::check(const Assignment& assignment, Positions joined,
                              support::Diagnostics& diagnostics) {
  if (joined == 0) return true;
  const int here = forms_.of(*assignment.value);
  for (std::uint8_t position = 0; position < links_.rows().size(); ++position) {
    if ((joined >> position & 1) == 0 || forms_.of(*assignment.value, position) == here) continue;
    report(assignment, position, diagnostics);
    return false;
  }
  return true;
}

void InvarianceChecker::report(const Assignment& assignment, std::uint8_t position,
                               support::Diagnostics& diagnostics) const {
  const gmap::EmbeddingDecl& embedding = schema_[assignment.embedding];
  types::ExprNames names{rule_.slot_names, {}, {}};
  for (const gmap::EmbeddingDecl& declared : schema_) names.embeddings.push_back(declared.name);

  std::map<std::uint32_t, ExprPtr> moved;
  for (NodeIndex node = 0; node < rule_.left.nodes.size(); ++node) {
    const types::Slot slot = rule_.left.nodes[node].slot;
    Expr local{ExprKind::Local, {types::ValueKind::Dart}, {}, assignment.span};
    local.slot = slot;
    ExprPtr dart = std::make_shared<Expr>(std::move(local));
    for (const int i : walk_to_next_row(links_, node, position)) dart = walk_one(dart, i);
    moved[types::index(slot)] = std::move(dart);
  }
  Substitution substitution(std::move(moved));
  for (const Step& step : rule_.steps)
    if (step.kind == Step::Kind::Let) substitution.add(step.slot, substitution.apply(step.value));
  const NodeIndex hook = rule_.hooks.front();
  const int link = rule_.left.nodes[hook].label[position];

  support::Diagnostic error{
      support::DiagnosticKind::NotInvariant,
      fmt::format("the value of `{}.{}` depends on the dart of the {} that it is evaluated at",
                  rule_.right.nodes[assignment.node].name, embedding.name,
                  orbit_in_words(embedding.orbit, rule_.dimension)),
      assignment.value->span};
  error.notes.push_back(
      fmt::format("moving along link {} gives `{}` instead of `{}`", link,
                  shortened(types::to_string(*substitution.apply(assignment.value), names)),
                  shortened(types::to_string(*assignment.value, names))));
  error.help =
      "write a value that is the same from every such dart, for example a mean or a sum over them";
  diagnostics.report(std::move(error));
}

}  // namespace gmsim::check
