// SPDX-License-Identifier: MIT
#include "scene/expression_facts.h"

#include <algorithm>
#include <vector>

namespace gmsim::scene {
namespace {

using types::Expr;
using types::ExprKind;

bool constant_within(const Expr& expr, std::vector<types::Slot>& bound) {
  switch (expr.kind) {
    case ExprKind::Local:
      return std::ranges::find(bound, expr.slot) != bound.end();
    case ExprKind::Alpha:
    case ExprKind::Free:
    case ExprKind::SameDart:
    case ExprKind::Embedding:
    case ExprKind::Has:
    case ExprKind::Time:
    case ExprKind::Step:
    case ExprKind::Dt:
    case ExprKind::Random:
    case ExprKind::OrbitDarts:
    case ExprKind::Quotient:
    case ExprKind::Polygon:
    case ExprKind::AllOrbits:
    case ExprKind::Forces:
    case ExprKind::ForceOn:
    case ExprKind::Grad:
      return false;
    default:
      break;
  }
  const bool binds = expr.kind == ExprKind::Let || expr.kind == ExprKind::Fold;
  for (std::size_t i = 0; i < expr.args.size(); ++i) {
    if (binds && i == 1) bound.push_back(expr.slot);  // seen by everything but the first argument
    if (!constant_within(*expr.args[i], bound)) return false;
  }
  if (binds && expr.args.size() > 1) bound.pop_back();
  return true;
}

}  // namespace

bool is_constant(const Expr& expr) {
  std::vector<types::Slot> bound;
  return constant_within(expr, bound);
}

void add_read(types::EmbeddingId id, const gmap::EmbeddingSchema& schema,
              std::set<types::EmbeddingId>& reads) {
  if (!reads.insert(id).second) return;
  const gmap::EmbeddingDecl& declaration = schema[id];
  if (declaration.derivation) add_reads(*declaration.derivation, schema, reads);
  if (declaration.weight) add_reads(*declaration.weight, schema, reads);
}

void add_reads(const Expr& expr, const gmap::EmbeddingSchema& schema,
               std::set<types::EmbeddingId>& reads) {
  if (expr.kind == ExprKind::Embedding || expr.kind == ExprKind::Has)
    add_read(expr.embedding, schema, reads);
  for (const types::ExprPtr& part : expr.args)
    if (part) add_reads(*part, schema, reads);
}

}  // namespace gmsim::scene
