// SPDX-License-Identifier: MIT
// Collections and folds of value programs: a fold is computed once for each lane of the domain to
// which its collection belongs, or, when its terms depend on more, of the domain in which it is
// written.
#include <algorithm>

#include "compile/value_compiler.h"

namespace gmsim::compile {

using types::Expr;
using types::ExprKind;
using types::FoldKind;
using types::ValueKind;

ValueCompiler::Collection ValueCompiler::collection(const Expr& expr) {
  switch (expr.kind) {
    case ExprKind::Local: {
      const Bound& bound = local(expr.slot);
      if (bound.kind != Bound::Kind::Members) throw NotExpressible{};
      return bound.members;
    }
    case ExprKind::Let: {
      const Binding binding(locals_, expr.slot, value_of(*expr.args[0]));
      return collection(*expr.args[1]);
    }
    case ExprKind::OrbitDarts:
      return {
          ValueOp::Members, expr.orbit, {}, graph_.any_dart_of(expr.orbit, dart(*expr.args[0]))};
    case ExprKind::Quotient:
      return {ValueOp::Quotient, expr.orbit, expr.orbit2,
              graph_.any_dart_of(expr.orbit, dart(*expr.args[0]))};
    case ExprKind::Polygon:
      return {ValueOp::Polygon, {}, {}, dart(*expr.args[0])};
    case ExprKind::AllOrbits:
      return {ValueOp::AllOrbits, expr.orbit, {}};
    case ExprKind::Range:
      return {ValueOp::Range, {}, {}, number(*expr.args[0]), number(*expr.args[1])};
    default:
      throw NotExpressible{};
  }
}

DomainId ValueCompiler::natural_domain(const Collection& collection) {
  DomainId domain = graph_.whole();
  for (const ValueId id : {collection.from, collection.to}) {
    if (id != LaneDomain::kNone) domain = graph_.join(domain, graph_.domain(id));
  }
  return domain;
}

/// The instruction that lists the members.
ValueId ValueCompiler::open(const Collection& collection, DomainId above) {
  ValueInstruction members{.op = collection.op,
                           .args = {collection.from, collection.to, LaneDomain::kNone}};
  members.orbit = collection.orbit;
  if (collection.op != ValueOp::Quotient) return graph_.open(members, above);
  members.op = ValueOp::Members;
  ValueInstruction quotient{.op = ValueOp::Quotient, .orbit = collection.orbit};
  quotient.args[0] = graph_.open(members, above);
  quotient.inner = collection.inner;
  return graph_.open(quotient, above);
}

ValueId ValueCompiler::fold(const Expr& expr) {
  const Collection collected = collection(*expr.args[0]);
  const DomainId natural = natural_domain(collected);
  const ValueId members = open(collected, natural);
  // A fold around this one may visit the same members.
  const bool own = std::none_of(expr.args.begin() + 1, expr.args.end(), [&](const auto& term) {
    return depends_on(*term, graph_.domain(members));
  });
  if (own) {
    try {
      return fold_over(expr, members);
    } catch (const ValueGraph::LanesDiffer&) {
      if (natural == scope_) throw;
    }
  }
  return fold_over(expr, open(collected, scope_));
}

/// Does a term speak of a local that belongs to lanes of the domain, or of one below it?
bool ValueCompiler::depends_on(const Expr& term, DomainId domain) const {
  if (term.kind == ExprKind::Local) {
    const Bound& bound = locals_[types::index(term.slot)];
    const auto below = [&](ValueId id) {
      return id != LaneDomain::kNone && graph_.is_above(domain, graph_.domain(id));
    };
    if (bound.kind == Bound::Kind::Value) return below(bound.value);
    if (bound.kind != Bound::Kind::Members) return false;
    return below(bound.members.from) || below(bound.members.to);
  }
  return std::any_of(term.args.begin(), term.args.end(),
                     [&](const types::ExprPtr& part) { return depends_on(*part, domain); });
}

ValueId ValueCompiler::fold_over(const Expr& expr, ValueId members) {
  const DomainId domain = graph_.domain(members);
  const Binding binding(locals_, expr.slot, {Bound::Kind::Value, members});
  const Restored<DomainId> scope(scope_, domain);
  ValueInstruction fold{.count = lane_components(expr.type)};
  const auto of_number = [&](ValueOp op, const Expr& term, std::uint32_t count) {
    fold.op = op;
    fold.args[0] = operand(term, count);
    return graph_.fold(fold, domain);
  };
  switch (expr.fold) {
    case FoldKind::Sum:
      return of_number(ValueOp::Sum, *expr.args[1], fold.count);
    case FoldKind::Mean:
      return of_number(ValueOp::Mean, *expr.args[1], fold.count);
    case FoldKind::Min:
      return of_number(ValueOp::Minimum, *expr.args[1], 1);
    case FoldKind::Max:
      return of_number(ValueOp::Maximum, *expr.args[1], 1);
    case FoldKind::Any:
      return of_number(ValueOp::Any, *expr.args[1], 1);
    case FoldKind::All:
      return of_number(ValueOp::All, *expr.args[1], 1);
    case FoldKind::Count:
      if (expr.args.size() > 1) return of_number(ValueOp::CountTrue, *expr.args[1], 1);
      fold.op = ValueOp::Count;
      return graph_.fold(fold, domain);
    case FoldKind::ArgMax:
    case FoldKind::ArgMin: {
      ValueInstruction best{.op =
                                expr.fold == FoldKind::ArgMax ? ValueOp::Highest : ValueOp::Lowest};
      best.args[0] = number(*expr.args[1]);
      const bool is_dart = expr.type.kind == ValueKind::Dart;
      fold.op = is_dart ? ValueOp::PickDart : ValueOp::Pick;
      fold.args[0] = graph_.fold(best, domain);
      fold.args[1] = is_dart ? dart(*expr.args[2]) : operand(*expr.args[2], fold.count);
      return graph_.fold(fold, domain);
    }
  }
  throw NotExpressible{};
}

}  // namespace gmsim::compile
