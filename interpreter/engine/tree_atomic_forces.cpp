// SPDX-License-Identifier: MIT
// Forces as values of expressions that are evaluated one at a time.
#include <algorithm>

#include "engine/atomic_forces.h"
#include "engine/tree_walker.h"

namespace gmsim::engine {

using types::Expr;

void TreeWalker::force_on(const Expr& expr, double* out) {
  std::fill_n(out, 3, 0.0);
  if (forces_ == nullptr) return unavailable(expr);
  DartId at;
  if (!live_dart(*expr.args[0], at)) return;
  const std::uint32_t only = expr.number == 1 ? types::index(expr.interaction) + 1 : 0;
  const VertexRecord sum = forces_->sum(expr.orbit, at, only);
  out[0] = sum.x;
  out[1] = sum.y;
  out[2] = sum.z;
}

std::vector<std::array<double, 3>> TreeWalker::atomic_forces(const Expr& collection) {
  std::vector<std::array<double, 3>> vectors;
  DartId at;
  if (forces_ == nullptr || collection.kind != types::ExprKind::Forces) {
    unavailable(collection);
  } else if (live_dart(*collection.args[0], at)) {
    for (const VertexRecord& force : forces_->list(collection.orbit, at))
      vectors.push_back({force.x, force.y, force.z});
  }
  return vectors;
}

}  // namespace gmsim::engine
