// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/tree_walker.h"
#include "gmap/orbit_walk.h"

namespace gmsim::engine {

using support::DiagnosticKind;
using types::Expr;
using types::ExprKind;
using types::FoldKind;

// ---- collections --------------------------------------------------------------------------------

void TreeWalker::darts(const Expr& expr, std::vector<DartId>& out) {
  DartId at;
  switch (expr.kind) {
    case ExprKind::Local:
      out = frame_->darts(expr.slot);
      return;
    case ExprKind::Let:
      return with_bound(expr, [&] { darts(*expr.args[1], out); });
    case ExprKind::If:
      return darts(branch(expr), out);
    case ExprKind::OrbitDarts:
      if (!live_dart(*expr.args[0], at)) return;
      gmap::for_each_dart(state_.map, expr.orbit, at, [&](DartId d) { out.push_back(d); });
      std::sort(out.begin(), out.end());
      return;
    case ExprKind::Quotient:
      return quotient(expr, out);
    case ExprKind::Polygon:
      return polygon(expr, out);
    case ExprKind::AllOrbits:
      out = gmap::all_orbits(state_.map, expr.orbit);
      return;
    case ExprKind::Forces:
      return unavailable(expr);
    default:
      support::internal_error(__FILE__, __LINE__, "expression has no darts");
  }
}

void TreeWalker::quotient(const Expr& expr, std::vector<DartId>& out) {
  DartId at;
  if (!live_dart(*expr.args[0], at)) return;
  gmap::for_each_dart(state_.map, expr.orbit, at, [&](DartId d) { out.push_back(d); });
  std::sort(out.begin(), out.end());
  filter_.start(expr.orbit, expr.orbit2);
  std::erase_if(out, [&](DartId d) { return !filter_.keeps(d); });
}

void TreeWalker::polygon(const Expr& expr, std::vector<DartId>& out) {
  DartId at;
  if (!live_dart(*expr.args[0], at)) return;
  std::optional<std::vector<DartId>> corners = gmap::polygon(state_.map, at);
  if (corners) {
    out = std::move(*corners);
    return;
  }
  std::string face;
  for (DartId d : gmap::orbit_darts(state_.map, OrbitType{0, 1}, at)) {
    face += fmt::format("{}{}", face.empty() ? "" : ", ", types::index(d));
  }
  fail(DiagnosticKind::OpenFace, expr,
       fmt::format("the face of dart {} is open: it has no boundary to go around",
                   types::index(at)));
  failure_->diagnostic.notes.push_back("the darts of the face are " + face);
}

// ---- folds --------------------------------------------------------------------------------------

template <typename Body>
void TreeWalker::each(const Expr& fold, const Body& body) {
  const Expr& collection = *fold.args[0];
  Frame::Cell& variable = frame_->cell(fold.slot);
  const Frame::Cell outer = variable;
  if (collection.type.kind == types::ValueKind::Range) {
    double range[2];
    numbers(collection, range);
    double number = range[0];
    variable = {Frame::Kind::Numbers, 1, types::kNoDart, &number, nullptr};
    for (; number < range[1] && !failed() && body(); number += 1.0) {
    }
  } else if (collection.type.kind == types::ValueKind::Forces) {
    std::vector<std::array<double, 3>> vectors = atomic_forces(collection);
    for (std::size_t i = 0; i < vectors.size() && !failed(); ++i) {
      variable = {Frame::Kind::Numbers, 3, types::kNoDart, vectors[i].data(), nullptr};
      if (!body()) break;
    }
  } else {
    const DartPool::Lease members(pool_);
    darts(collection, *members);
    variable = {Frame::Kind::Dart};
    for (std::size_t i = 0; i < members->size() && !failed(); ++i) {
      variable.dart = (*members)[i];
      if (!body()) break;
    }
  }
  variable = outer;
}

void TreeWalker::fail_empty(const Expr& expr) {
  static constexpr std::pair<FoldKind, const char*> kNames[] = {
      {FoldKind::Mean, "mean"},     {FoldKind::Min, "min"},       {FoldKind::Max, "max"},
      {FoldKind::ArgMax, "argmax"}, {FoldKind::ArgMin, "argmin"},
  };
  const auto* name = std::find_if(std::begin(kNames), std::end(kNames),
                                  [&](const auto& row) { return row.first == expr.fold; });
  fail(DiagnosticKind::EmptyFold, expr, fmt::format("`{}` of nothing has no value", name->second));
}

void TreeWalker::fold(const Expr& expr, double* out) {
  switch (expr.fold) {
    case FoldKind::Sum:
    case FoldKind::Mean:
      return fold_sum(expr, out);
    case FoldKind::Min:
    case FoldKind::Max:
      return fold_extreme(expr, out);
    case FoldKind::Count:
      *out = fold_count(expr);
      return;
    case FoldKind::Any:
    case FoldKind::All:
      *out = fold_truth(expr);
      return;
    case FoldKind::ArgMax:
    case FoldKind::ArgMin:
      std::fill_n(out, types::number_count(expr.type), 0.0);
      return fold_best(expr, [&] { numbers(*expr.args[2], out); });
  }
}

void TreeWalker::fold_sum(const Expr& expr, double* out) {
  const std::uint32_t count = types::number_count(expr.type);
  const Arena::Mark mark = frame_->arena_.mark();
  double* term = frame_->arena_.allocate(count);
  std::fill_n(out, count, 0.0);
  std::uint64_t terms = 0;
  each(expr, [&] {
    operand(*expr.args[1], count, term);
    for (std::uint32_t i = 0; i < count; ++i) out[i] += term[i];
    ++terms;
    return true;
  });
  frame_->arena_.release(mark);
  if (expr.fold != FoldKind::Mean) return;
  if (terms == 0) return fail_empty(expr);
  for (std::uint32_t i = 0; i < count; ++i) out[i] /= static_cast<double>(terms);
}

void TreeWalker::fold_extreme(const Expr& expr, double* out) {
  bool found = false;
  *out = 0.0;
  each(expr, [&] {
    const double value = scalar(*expr.args[1]);
    if (std::isnan(value)) fail(DiagnosticKind::NonFinite, *expr.args[1], "not a number");
    if (!found || (expr.fold == FoldKind::Min ? value < *out : value > *out)) *out = value;
    return found = true;
  });
  if (!found) fail_empty(expr);
}

double TreeWalker::fold_count(const Expr& expr) {
  double count = 0.0;
  each(expr, [&] {
    if (expr.args.size() < 2 || truth(*expr.args[1])) count += 1.0;
    return true;
  });
  return count;
}

double TreeWalker::fold_truth(const Expr& expr) {
  const bool stop_at = expr.fold == FoldKind::Any;
  bool result = !stop_at;
  each(expr, [&] {
    if (truth(*expr.args[1]) == stop_at) result = stop_at;
    return result != stop_at;
  });
  return result ? 1.0 : 0.0;
}

template <typename Body>
void TreeWalker::fold_best(const Expr& expr, const Body& body) {
  bool found = false;
  double best = 0.0;
  Frame::Cell winner;
  std::array<double, 3> numbers_of_best{};  // when the variable is a number or a force
  each(expr, [&] {
    const double key = scalar(*expr.args[1]);
    if (std::isnan(key)) fail(DiagnosticKind::NonFinite, *expr.args[1], "not a number");
    if (!found || (expr.fold == FoldKind::ArgMin ? key < best : key > best)) {
      best = key;
      winner = frame_->cell(expr.slot);
      if (winner.kind == Frame::Kind::Numbers)
        std::copy_n(winner.numbers, winner.count, numbers_of_best.begin());
    }
    return found = true;
  });
  if (!found) return fail_empty(expr);
  if (winner.kind == Frame::Kind::Numbers) winner.numbers = numbers_of_best.data();
  const Frame::Cell outer = std::exchange(frame_->cell(expr.slot), winner);
  body();
  frame_->cell(expr.slot) = outer;
}

DartId TreeWalker::fold_dart(const Expr& expr) {
  DartId result = types::kNoDart;
  fold_best(expr, [&] { result = dart(*expr.args[2]); });
  return result;
}

}  // namespace gmsim::engine
