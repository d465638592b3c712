// SPDX-License-Identifier: MIT
#include "compile/expression_search.h"

#include <algorithm>

namespace gmsim::compile {

using types::Expr;
using types::ExprKind;

bool any_node(const Expr& expr, const gmap::EmbeddingSchema& schema,
              const std::function<bool(const Expr&)>& wanted) {
  if (wanted(expr)) return true;
  if (expr.kind == ExprKind::Embedding) {
    const types::ExprPtr& derivation = schema[expr.embedding].derivation;
    if (derivation && any_node(*derivation, schema, wanted)) return true;
  }
  return std::any_of(expr.args.begin(), expr.args.end(), [&](const types::ExprPtr& part) {
    return part && any_node(*part, schema, wanted);
  });
}

bool reads_forces(const Expr& expr, const gmap::EmbeddingSchema& schema) {
  return any_node(expr, schema, [](const Expr& node) {
    return node.kind == ExprKind::ForceOn || node.kind == ExprKind::Forces;
  });
}

bool reads_clock(const Expr& expr, const gmap::EmbeddingSchema& schema) {
  return any_node(expr, schema, [](const Expr& node) {
    return node.kind == ExprKind::Time || node.kind == ExprKind::Step || node.kind == ExprKind::Dt;
  });
}

}  // namespace gmsim::compile
