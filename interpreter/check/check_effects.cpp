// SPDX-License-Identifier: MIT
#include <algorithm>
#include <unordered_set>

#include "check/known_links.h"
#include "check/passes.h"

namespace gmsim::check {
namespace {

using types::Expr;
using types::ExprKind;

class FootprintMaker {
 public:
  void read(const ExprPtr& expr) {
    if (!expr || !seen_.insert(expr.get()).second) return;
    for (const ExprPtr& arg : expr->args) read(arg);
    switch (expr->kind) {
      case ExprKind::Alpha:
      case ExprKind::Free:
        follow(expr->number);
        break;
      case ExprKind::Embedding:
      case ExprKind::Has:
        made_.reads.push_back(expr->embedding);
        break;
      case ExprKind::Time:
      case ExprKind::Step:
        made_.reads_time = true;
        break;
      case ExprKind::Forces:
      case ExprKind::ForceOn:
        made_.reads_forces = true;
        follow(expr->orbit);
        break;
      case ExprKind::OrbitDarts:
      case ExprKind::Random:
      case ExprKind::AllOrbits:
        follow(expr->orbit);
        break;
      case ExprKind::Quotient:
        follow(expr->orbit);
        follow(expr->orbit2);
        break;
      case ExprKind::Polygon:
        follow(OrbitType{0, 1});
        break;
      default:
        break;
    }
  }
  void read(const std::vector<Parameter>& parameters) {
    for (const Parameter& parameter : parameters) read(parameter.default_value);
  }
  void read(const std::vector<Step>& steps) {
    for (const Step& step : steps) read(step.value);
  }
  void read(const Pattern& pattern) {
    for (const PatternNode& node : pattern.nodes)
      for (const LabelEntry entry : node.label)
        if (entry != kBlank) follow(entry);
    for (const PatternArc& arc : pattern.arcs) follow(arc.dimension);
    for (const PatternPath& path : pattern.paths)
      for (const int i : path.dimensions) follow(i);
  }
  void write(EmbeddingId embedding) { made_.writes.push_back(embedding); }

  /// The links that differ between the sides of a rule.
  void write_links(const Rule& rule) {
    const std::vector<NodeLinks> left = written_links(rule.left), right = written_links(rule.right);
    const auto all = [&](const NodeLinks& links) {
      for (int i = 0; i <= rule.dimension; ++i)
        if (links[i]) made_.writes_links.insert(i);
    };
    for (NodeIndex node = 0; node < left.size(); ++node) {
      if (rule.left_to_right[node]) continue;
      made_.removes_darts = true;
      all(left[node]);
    }
    for (NodeIndex node = 0; node < right.size(); ++node) {
      if (!rule.right_to_left[node]) {
        made_.creates_darts = true;
        all(right[node]);
        continue;
      }
      for (int i = 0; i <= rule.dimension; ++i)
        if (!same_link(rule, left[*rule.right_to_left[node]][i], right[node][i]))
          made_.writes_links.insert(i);
    }
  }

  void take_in(const Footprint& other) {
    made_.reads.insert(made_.reads.end(), other.reads.begin(), other.reads.end());
    made_.writes.insert(made_.writes.end(), other.writes.begin(), other.writes.end());
    follow(other.reads_links);
    made_.writes_links =
        OrbitType::from_bits(made_.writes_links.bits() | other.writes_links.bits());
    made_.creates_darts |= other.creates_darts;
    made_.removes_darts |= other.removes_darts;
    made_.reads_forces |= other.reads_forces;
    made_.reads_time |= other.reads_time;
  }

  Footprint take() {
    for (std::vector<EmbeddingId>* list : {&made_.reads, &made_.writes}) {
      std::sort(list->begin(), list->end());
      list->erase(std::unique(list->begin(), list->end()), list->end());
    }
    return std::move(made_);
  }

 private:
  void follow(int dimension) { made_.reads_links.insert(dimension); }
  void follow(OrbitType type) {
    made_.reads_links = OrbitType::from_bits(made_.reads_links.bits() | type.bits());
  }
  static bool same_link(const Rule& rule, const std::optional<LinkTarget>& left,
                        const std::optional<LinkTarget>& right) {
    if (!left || !right) return left.has_value() == right.has_value();
    return rule.left_to_right[left->node] == right->node && left->rows == right->rows;
  }

  Footprint made_;
  std::unordered_set<const Expr*> seen_;
};

class OperationFootprint {
 public:
  explicit OperationFootprint(const RuleLibrary& library) : library_(library) {}

  Footprint of(const Operation& operation) {
    maker_.read(operation.parameters);
    read(operation.body);
    return maker_.take();
  }

 private:
  void read(const std::vector<OperationStatement>& body) {
    for (const OperationStatement& statement : body)
      std::visit([&](const auto& node) { read(node); }, statement.node);
  }
  void read(const OpLet& let) { maker_.read(let.value); }
  void read(const OpAssign& assign) {
    maker_.read(assign.dart);
    maker_.read(assign.value);
    maker_.write(assign.embedding);
  }
  void read(const OpFor& loop) {
    maker_.read(loop.collection);
    maker_.read(loop.condition);
    read(loop.body);
  }
  void read(const OpIf& branch) {
    maker_.read(branch.condition);
    read(branch.then_body);
    read(branch.else_body);
  }
  void read(const OpApply& apply) {
    for (const ExprPtr& dart : apply.darts) maker_.read(dart);
    for (const auto& [slot, value] : apply.parameters) maker_.read(value);
    maker_.take_in(apply.operation ? library_.operations.at(apply.target).footprint
                                   : library_.rules.at(apply.target).footprint);
  }

  const RuleLibrary& library_;
  FootprintMaker maker_;
};

}  // namespace

Footprint footprint(const Rule& rule) {
  FootprintMaker maker;
  maker.read(rule.left);
  maker.read(rule.parameters);
  maker.read(rule.steps);
  for (const Assignment& assignment : rule.assignments) {
    maker.read(assignment.value);
    maker.write(assignment.embedding);
  }
  if (rule.has_right) maker.write_links(rule);
  return maker.take();
}

Footprint footprint(const Interaction& interaction) {
  FootprintMaker maker;
  maker.read(interaction.match);
  maker.read(interaction.first);
  maker.read(interaction.parameters);
  maker.read(interaction.steps);
  maker.read(interaction.energy);
  for (const ForceLine& line : interaction.forces) {
    for (const ExprPtr& target : line.targets) maker.read(target);
    maker.read(line.collection);
    maker.read(line.value);
  }
  for (const Result& result : interaction.results) {
    maker.read(result.value);
    if (result.embedding) maker.write(*result.embedding);
  }
  return maker.take();
}

Footprint footprint(const Criterion& criterion) {
  FootprintMaker maker;
  maker.read(criterion.match);
  maker.read(criterion.parameters);
  maker.read(criterion.steps);
  maker.read(criterion.value);
  for (const Result& result : criterion.results) maker.read(result.value);
  return maker.take();
}

Footprint footprint(const Operation& operation, const RuleLibrary& library) {
  return OperationFootprint(library).of(operation);
}

}  // namespace gmsim::check
