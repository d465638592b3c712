// SPDX-License-Identifier: MIT
// Collections of darts, and folds over them: unrolled, so that the number of members is a decision.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "compile/symbolic_walker.h"
#include "compile/value_parts.h"
#include "gmap/orbit_walk.h"

namespace gmsim::compile {

using support::DiagnosticKind;
using types::Expr;
using types::ExprKind;
using types::FoldKind;
using types::ValueKind;

// ---- collections --------------------------------------------------------------------------------

std::shared_ptr<const std::vector<DartRef>> SymbolicWalker::members(const Expr& collection) {
  if (collection.kind == ExprKind::Local || collection.kind == ExprKind::Let ||
      collection.kind == ExprKind::If) {
    std::shared_ptr<const std::vector<DartRef>> found = evaluate(collection).darts;
    return found ? found : std::make_shared<const std::vector<DartRef>>();
  }
  auto out = std::make_shared<std::vector<DartRef>>();
  darts(collection, *out);
  return out;
}

void SymbolicWalker::darts(const Expr& expr, std::vector<DartRef>& out) {
  if (expr.kind == ExprKind::Polygon) return polygon(expr, out);
  const auto append = [&](DartId d) { out.push_back({d, kNoWalk}); };
  switch (expr.kind) {
    case ExprKind::OrbitDarts: {
      const DartRef at = dart(*expr.args[0]);
      if (failed()) return;
      if (expr.orbit.empty()) {
        out.push_back(at);
        return;
      }
      depend(expr.orbit, at.dart);
      gmap::for_each_dart(world_.map, expr.orbit, at.dart, append);
      std::sort(out.begin(), out.end(),
                [](const DartRef& a, const DartRef& b) { return a.dart < b.dart; });
      trace_orbit(expr.orbit, at, out);
      break;
    }
    case ExprKind::Quotient: {
      const DartRef at = dart(*expr.args[0]);
      if (failed()) return;
      for (const DartId d : walked_.quotient(expr.orbit, expr.orbit2, at.dart)) append(d);
      trace_quotient(expr.orbit, expr.orbit2, at, out);
      break;
    }
    case ExprKind::AllOrbits:
      everywhere_ = true;
      trace_.spoil();
      for (const DartId d : gmap::all_orbits(world_.map, expr.orbit)) append(d);
      break;
    default:
      out = *members(expr);
      return;
  }
  decide(static_cast<std::uint32_t>(out.size()));
}

/// Walks to all darts of an orbit, breadth first.
std::vector<DartRef> SymbolicWalker::traced_orbit(OrbitType type, DartRef at) {
  std::vector<DartRef> found{at};
  for (std::size_t k = 0; k < found.size() && trace_.straight(); ++k) {
    for (int i = 0; i <= world_.map.dimension(); ++i) {
      if (!type.contains(i)) continue;
      const DartRef next{world_.map.alpha(i, found[k].dart), trace_.follow(found[k].walk, i)};
      const auto known = std::find_if(found.begin(), found.end(), [&](const DartRef& other) {
        return other.dart == next.dart;
      });
      if (known != found.end()) {
        trace_.test(next.walk, known->walk, true);
        continue;
      }
      for (const DartRef& other : found) trace_.test(next.walk, other.walk, false);
      found.push_back(next);
    }
  }
  return found;
}

/// Gives ascending members of a traced orbit their walks; that they ascend decides.
void SymbolicWalker::trace_orbit(OrbitType type, DartRef at, std::vector<DartRef>& members) {
  if (!trace_.straight()) return;
  const std::vector<DartRef> walked = traced_orbit(type, at);
  if (!trace_.straight()) return;
  for (DartRef& member : members)
    member.walk = std::find_if(walked.begin(), walked.end(), [&](const DartRef& other) {
                    return other.dart == member.dart;
                  })->walk;
  for (std::size_t k = 1; k < members.size(); ++k)
    trace_.older(members[k - 1].walk, members[k].walk);
}

void SymbolicWalker::trace_quotient(OrbitType outer, OrbitType inner, DartRef at,
                                    std::vector<DartRef>& members) {
  if (!trace_.straight()) return;
  std::vector<DartRef> all;
  gmap::for_each_dart(world_.map, outer, at.dart, [&](DartId d) { all.push_back({d, kNoWalk}); });
  std::sort(all.begin(), all.end(),
            [](const DartRef& a, const DartRef& b) { return a.dart < b.dart; });
  trace_orbit(outer, at, all);
  if (!trace_.straight()) return;
  const gmap::OrbitIndex* index = world_.store.find_index(inner);
  if (!outer.contains(inner) && index != nullptr)
    for (std::size_t k = 1; k < all.size(); ++k)
      for (std::size_t i = 0; i < k; ++i)
        trace_.test_orbit(*index, all[i].walk, all[k].walk,
                          index->row(all[i].dart) == index->row(all[k].dart));
  for (DartRef& member : members) {
    member.walk = std::find_if(all.begin(), all.end(), [&](const DartRef& other) {
                    return other.dart == member.dart;
                  })->walk;
    if (outer.contains(inner) || index != nullptr) continue;
    // Which darts of the outer orbit it stands for is not decided by links within that orbit.
    for (const DartRef& met : traced_orbit(inner, member))
      for (const DartRef& dart : all) trace_.test(met.walk, dart.walk, met.dart == dart.dart);
  }
}

void SymbolicWalker::polygon(const Expr& expr, std::vector<DartRef>& out) {
  const DartRef at = dart(*expr.args[0]);
  if (failed()) return;
  const auto corners = gmap::polygon(world_.map, at.dart);
  if (!corners) {
    depend(OrbitType{0, 1}, at.dart);
    fail(DiagnosticKind::OpenFace, expr.span,
         fmt::format("the face of dart {} is open: it has no boundary to go around",
                     types::index(at.dart)));
    return;
  }
  for (const DartId d : *corners) {
    out.push_back({d, kNoWalk});
    depend(d);
    depend(world_.map.alpha(0, d));
  }
  trace_polygon(at, out);
  decide(static_cast<std::uint32_t>(out.size()));
}

/// A polygon has as many corners as walks @0@1 differ from the first; on its way none is free.
void SymbolicWalker::trace_polygon(DartRef first, std::vector<DartRef>& corners) {
  std::uint32_t walk = first.walk;
  for (DartRef& corner : corners) {
    corner.walk = walk;
    const std::uint32_t other_end = trace_.follow(walk, 0);
    trace_.test(walk, other_end, false);
    walk = trace_.follow(other_end, 1);
    trace_.test(other_end, walk, false);
    trace_.test(walk, first.walk, &corner == &corners.back());
  }
}

// ---- folds --------------------------------------------------------------------------------------

/// Calls body() with the fold's variable bound to each member until body returns false.
template <typename Body>
void SymbolicWalker::each(const Expr& fold, const Body& body) {
  const Expr& collection = *fold.args[0];
  Cell outer;
  if (collection.type.kind == ValueKind::Range) {
    const SymbolicValue range = evaluate(collection);
    std::swap(outer, cell(fold.slot));
    for (double i = range.number; i < range.upper && !failed(); i += 1.0) {
      bind(fold.slot, SymbolicValue::of(i));
      if (!body()) break;
    }
  } else if (collection.type.kind == ValueKind::Forces) {
    const SymbolicValue all = evaluate(collection);
    if (failed()) return;
    std::swap(outer, cell(fold.slot));
    for (const std::uint32_t number : *all.forces) {
      if (failed()) break;
      bind(fold.slot, atomic_force(collection, number));
      if (!body()) break;
    }
  } else {
    const auto all = members(collection);
    std::swap(outer, cell(fold.slot));
    for (const DartRef& member : *all) {
      if (failed()) break;
      bind(fold.slot, member);
      if (!body()) break;
    }
  }
  std::swap(outer, cell(fold.slot));
}

void SymbolicWalker::fail_empty(const Expr& expr) {
  static constexpr std::pair<FoldKind, const char*> kNames[] = {
      {FoldKind::Mean, "mean"},     {FoldKind::Min, "min"},       {FoldKind::Max, "max"},
      {FoldKind::ArgMax, "argmax"}, {FoldKind::ArgMin, "argmin"},
  };
  const auto* name = std::find_if(std::begin(kNames), std::end(kNames),
                                  [&](const auto& row) { return row.first == expr.fold; });
  fail(DiagnosticKind::EmptyFold, expr.span, fmt::format("`{}` of nothing has no value", name->second));
}

SymbolicValue SymbolicWalker::fold(const Expr& expr) {
  switch (expr.fold) {
    case FoldKind::Sum:
    case FoldKind::Mean:
      return fold_sum(expr);
    case FoldKind::Min:
    case FoldKind::Max:
      return fold_extreme(expr);
    case FoldKind::Count:
      return fold_count(expr);
    case FoldKind::Any:
    case FoldKind::All:
      return fold_truth(expr);
    case FoldKind::ArgMax:
    case FoldKind::ArgMin:
      return fold_best(expr);
  }
  return {};
}

SymbolicValue SymbolicWalker::fold_sum(const Expr& expr) {
  SymbolicValue sum;
  double terms = 0.0;
  each(expr, [&] {
    const SymbolicValue term = operand(*expr.args[1], expr.type);
    sum = terms == 0.0 ? term : add(expr, sum, term, expr.type);
    terms += 1.0;
    return true;
  });
  if (failed()) return {};
  if (terms != 0.0)
    return expr.fold == FoldKind::Mean ? divide(expr, sum, SymbolicValue::of(terms), expr.type)
                                       : sum;
  if (expr.fold == FoldKind::Mean) {
    fail_empty(expr);
    return {};
  }
  const std::vector<double> zeros(types::component_count(expr.type), 0.0);
  return constant(expr.type, zeros);
}

SymbolicValue SymbolicWalker::fold_extreme(const Expr& expr) {
  SymbolicValue best;
  bool found = false;
  const bool smallest = expr.fold == FoldKind::Min;
  each(expr, [&] {
    const SymbolicValue value = evaluate(*expr.args[1]);
    if (!found) {
      best = value;
    } else if (best.known && value.known) {
      if (smallest ? value.number < best.number : value.number > best.number) best = value;
    } else {
      best = of_parts({make(expr, smallest ? Op::Min : Op::Max, part(best, 0), part(value, 0))});
    }
    return found = true;
  });
  if (!found && !failed()) fail_empty(expr);
  return best;
}

SymbolicValue SymbolicWalker::fold_count(const Expr& expr) {
  SymbolicValue count = SymbolicValue::of(0.0);
  each(expr, [&] {
    SymbolicValue one = expr.args.size() < 2 ? SymbolicValue::of(1.0) : evaluate(*expr.args[1]);
    if (one.known) {
      one.number = one.number != 0.0 ? 1.0 : 0.0;
    } else {
      one = of_parts({make(expr, Op::AsReal, part(one, 0))});
    }
    count = add(expr, count, one, {ValueKind::Real});
    return true;
  });
  return count;
}

SymbolicValue SymbolicWalker::fold_truth(const Expr& expr) {
  const bool any = expr.fold == FoldKind::Any;
  SymbolicValue result = SymbolicValue::of(any ? 0.0 : 1.0);
  each(expr, [&] {
    const SymbolicValue truth = evaluate(*expr.args[1]);
    if (truth.known) {
      const bool decides = (truth.number != 0.0) == any;
      if (decides) result = SymbolicValue::of(any ? 1.0 : 0.0);
      return !decides;
    }
    const NodeId so_far = node(result, {ValueKind::Bool});
    result = of_parts({make(expr, any ? Op::Or : Op::And, so_far, part(truth, 0))});
    return true;
  });
  return result;
}

/// The result at the best key. Known keys choose a member; others choose between the results.
SymbolicValue SymbolicWalker::fold_best(const Expr& expr) {
  std::vector<SymbolicValue> keys;
  each(expr, [&] {
    keys.push_back(evaluate(*expr.args[1]));
    return true;
  });
  if (failed()) return {};
  if (keys.empty()) {
    fail_empty(expr);
    return {};
  }
  const bool largest = expr.fold == FoldKind::ArgMax;
  const bool known = std::all_of(keys.begin(), keys.end(), [](const auto& key) { return key.known; });
  std::size_t winner = 0;
  for (std::size_t i = 1; known && i < keys.size(); ++i) {
    const double key = keys[i].number, best = keys[winner].number;
    if (largest ? key > best : key < best) winner = i;
  }
  if (!known && keys.size() > 1 && expr.type.kind == ValueKind::Dart) {
    fail(DiagnosticKind::NotConstant, expr.span,
         "which dart is the best depends on numbers that may change at every step",
         "give a value as the result: `argmax(x in … : key : x.position)`");
    return {};
  }
  const bool decided = known || keys.size() == 1;
  SymbolicValue result;
  NodeId best = part(keys[0], 0);
  std::size_t i = 0;
  each(expr, [&] {
    const std::size_t at = i++;
    if (decided && at != winner) return true;
    const SymbolicValue value = expr.type.kind == ValueKind::Dart
                                    ? SymbolicValue::of(dart(*expr.args[2]))
                                    : operand(*expr.args[2], expr.type);
    if (decided || at == 0) {
      result = value;
      return !decided;
    }
    if (graph_ == nullptr || failed()) return true;
    const NodeId key = part(keys[at], 0);
    const NodeId better = largest ? make(expr, Op::Less, best, key) : make(expr, Op::Less, key, best);
    result = select(expr, better, value, result);
    best = make(expr, largest ? Op::Max : Op::Min, best, key);
    return true;
  });
  if (!decided && graph_ == nullptr) return {};
  return result;
}

}  // namespace gmsim::compile
