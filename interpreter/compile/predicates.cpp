// SPDX-License-Identifier: MIT
#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "compile/compile.h"

namespace gmsim::compile {

namespace {

using types::Expr;
using types::ExprKind;
using types::FoldKind;

bool never_empty(const Expr& collection) {
  return collection.kind == ExprKind::OrbitDarts || collection.kind == ExprKind::Quotient;
}

/// Has the expression itself, its arguments aside, a value on every map with complete data?
bool always_defined(const Expr& expr, const gmap::EmbeddingSchema& schema) {
  switch (expr.kind) {
    case ExprKind::Embedding: {
      const gmap::EmbeddingDecl& decl = schema[expr.embedding];
      return !decl.optional && decl.kind != gmap::EmbeddingKind::Derived;
    }
    case ExprKind::Fold:
      switch (expr.fold) {
        case FoldKind::Sum:
        case FoldKind::Count:
        case FoldKind::Any:
        case FoldKind::All:
          return true;
        case FoldKind::Mean:
        case FoldKind::Min:
        case FoldKind::Max:
        case FoldKind::ArgMax:
        case FoldKind::ArgMin:
          return never_empty(*expr.args.front());
      }
      return false;
    case ExprKind::Polygon:
    case ExprKind::Index:
    case ExprKind::Forces:
    case ExprKind::ForceOn:
    case ExprKind::Grad:
      return false;
    default:
      return true;
  }
}

/// What one expression needs; shared subtrees are visited once.
class Needs {
 public:
  Needs(const ExprPtr& expr, const gmap::EmbeddingSchema& schema) : schema_(schema) { visit(expr); }

  [[nodiscard]] bool total() const { return total_; }
  [[nodiscard]] const std::unordered_set<std::uint32_t>& slots() const { return slots_; }

 private:
  void visit(const ExprPtr& expr) {
    if (!expr || !seen_.insert(expr.get()).second) return;
    total_ = total_ && always_defined(*expr, schema_);
    if (expr->kind == ExprKind::Local) slots_.insert(types::index(expr->slot));
    for (const ExprPtr& argument : expr->args) visit(argument);
  }

  const gmap::EmbeddingSchema& schema_;
  bool total_ = true;
  std::unordered_set<std::uint32_t> slots_;
  std::unordered_set<const Expr*> seen_;
};

/// The number of links after which each slot has its value.
class Availability {
 public:
  explicit Availability(const MatchPlan& plan) {
    for (Column hook : plan.hooks) set(plan.nodes[hook].slot, 0);
    for (std::uint32_t i = 0; i < plan.links.size(); ++i) {
      const LinkStep& step = plan.links[i];
      const bool follows =
          step.kind == LinkStep::Kind::Follow || step.kind == LinkStep::Kind::FollowPath;
      if (follows) set(plan.nodes[step.to].slot, i + 1);
    }
  }
  void set(Slot slot, std::uint32_t after) { after_[types::index(slot)] = after; }
  [[nodiscard]] std::uint32_t of(const Needs& needs) const {
    std::uint32_t after = 0;
    for (std::uint32_t slot : needs.slots()) {
      const auto found = after_.find(slot);
      if (found != after_.end()) after = std::max(after, found->second);
    }
    return after;
  }

 private:
  std::unordered_map<std::uint32_t, std::uint32_t> after_;
};

std::vector<Predicate> listed(const std::vector<check::Parameter>& parameters,
                              const std::vector<check::Step>& steps) {
  std::vector<Predicate> predicates;
  for (const check::Parameter& parameter : parameters) {
    if (!parameter.default_value) continue;
    predicates.push_back({Predicate::Kind::Parameter, parameter.slot, parameter.default_value});
  }
  for (const check::Step& step : steps) {
    const bool let = step.kind == check::Step::Kind::Let;
    predicates.push_back(
        {let ? Predicate::Kind::Let : Predicate::Kind::Where, step.slot, step.value});
  }
  return predicates;
}

}  // namespace

void add_predicates(MatchPlan& plan, const std::vector<check::Parameter>& parameters,
                    const std::vector<check::Step>& steps, const gmap::EmbeddingSchema& schema) {
  plan.predicates = listed(parameters, steps);
  Availability availability(plan);
  bool early = true;  // what follows a step that can fail must wait for it
  for (Predicate& predicate : plan.predicates) {
    const Needs needs(predicate.value, schema);
    early = early && needs.total();
    predicate.after = early ? availability.of(needs) : Predicate::kWholeMatch;
    if (predicate.kind != Predicate::Kind::Where) availability.set(predicate.slot, predicate.after);
  }
  std::stable_sort(plan.predicates.begin(), plan.predicates.end(),
                   [](const Predicate& a, const Predicate& b) { return a.after < b.after; });
}

}  // namespace gmsim::compile
