// SPDX-License-Identifier: MIT
#include "check/differentiable.h"

#include <set>
#include <utility>

#include "check/make_expr.h"

namespace gmsim::check {
using support::DiagnosticKind;
using types::Builtin;
using types::Expr;
namespace {

class Differentiable {
 public:
  Differentiable(std::string what, ItemContext& context)
      : what_(std::move(what)), context_(context), schema_(context.env.library->schema),
        position_(schema_.find("position")) {}

  void visit(const Expr& expr) {
    if (expr.kind == ExprKind::Frozen || !done_.insert(&expr).second) return;
    switch (expr.kind) {
      case ExprKind::Call:
        if (expr.builtin == Builtin::Floor || expr.builtin == Builtin::Ceil ||
            expr.builtin == Builtin::Mod)
          report(expr.span, "`" + std::string(types::info(expr.builtin).name) + "` jumps");
        break;
      case ExprKind::ForceOn:
      case ExprKind::Forces: report(expr.span, "forces have none"); break;
      case ExprKind::Embedding: {
        const gmap::EmbeddingDecl& value = schema_[expr.embedding];
        followed_.clear();
        if (moves_with_positions(expr.embedding))
          report(expr.span, "`" + value.name + "` is computed from positions on its own");
        break;
      }
      default: break;
    }
    for (const ExprPtr& arg : expr.args) visit(*arg);
  }

 private:
  bool moves_with_positions(EmbeddingId id) {
    const gmap::EmbeddingDecl& value = schema_[id];
    if (value.role == gmap::EmbeddingRole::Result) return true;
    if (!value.derivation || !followed_.insert(id).second) return false;
    bool moves = false;
    for_each_node(value.derivation, [&](const Expr& node) {
      if (node.kind == ExprKind::Embedding && position_)
        moves |= node.embedding == *position_ || moves_with_positions(node.embedding);
    });
    return moves;
  }

  void report(Span place, const std::string& why) {
    context_.report({.kind = DiagnosticKind::NotDifferentiable,
                     .message = what_ + " is differentiated, and " + why,
                     .place = place,
                     .help = "write it as a function of positions, or hold it with `frozen(…)`"});
  }

  std::string what_;
  ItemContext& context_;
  const gmap::EmbeddingSchema& schema_;
  std::optional<EmbeddingId> position_;
  std::set<const Expr*> done_;
  std::set<EmbeddingId> followed_;
};

}  // namespace

void check_differentiable(const ExprPtr& expr, const std::string& what, ItemContext& context) {
  Differentiable(what, context).visit(*expr);
}

}  // namespace gmsim::check
