// SPDX-License-Identifier: MIT
#include "engine/tree_eval.h"

#include "engine/tree_walker.h"

namespace gmsim::engine {

TreeEvaluator::TreeEvaluator(const State& state) : walker_(std::make_unique<TreeWalker>(state)) {}
TreeEvaluator::~TreeEvaluator() = default;

void TreeEvaluator::read_forces(const AtomicForceReader* forces) { walker_->read_forces(forces); }

bool TreeEvaluator::failed() const { return walker_->failed(); }
EvalFailure TreeEvaluator::take_failure() { return walker_->take_failure(); }

bool TreeEvaluator::evaluate(const types::Expr& expr, Frame& frame, std::span<double> out) {
  const TreeWalker::Entry entry(*walker_, frame);
  GMSIM_CHECK(out.size() == types::number_count(expr.type), "room for another number of components");
  walker_->numbers(expr, out.data());
  return !failed();
}

bool TreeEvaluator::evaluate_bool(const types::Expr& expr, Frame& frame, bool& out) {
  const TreeWalker::Entry entry(*walker_, frame);
  out = walker_->scalar(expr) != 0.0;
  return !failed();
}

bool TreeEvaluator::evaluate_dart(const types::Expr& expr, Frame& frame, DartId& out) {
  const TreeWalker::Entry entry(*walker_, frame);
  out = walker_->dart(expr);
  return !failed();
}

bool TreeEvaluator::evaluate_darts(const types::Expr& expr, Frame& frame,
                                   std::vector<DartId>& out) {
  const TreeWalker::Entry entry(*walker_, frame);
  out.clear();
  walker_->darts(expr, out);
  return !failed();
}

std::optional<types::Value> TreeEvaluator::evaluate(const types::Expr& expr, Frame& frame) {
  const TreeWalker::Entry entry(*walker_, frame);
  types::Value value{expr.type};
  switch (expr.type.kind) {
    case types::ValueKind::Dart:
      value.dart = walker_->dart(expr);
      break;
    case types::ValueKind::Darts:
      walker_->darts(expr, value.darts);
      break;
    default:
      value.data.resize(types::number_count(expr.type));
      walker_->numbers(expr, value.data.data());
  }
  if (failed()) return std::nullopt;
  return value;
}

bool TreeEvaluator::assign(const types::Expr& expr, types::Slot slot, Frame& frame) {
  const TreeWalker::Entry entry(*walker_, frame);
  walker_->assign(expr, slot);
  return !failed();
}

bool TreeEvaluator::read(EmbeddingId id, DartId dart, std::span<double> out) {
  Frame frame;
  const TreeWalker::Entry entry(*walker_, frame);
  walker_->read(id, dart, out.data(), nullptr);
  return !failed();
}

}  // namespace gmsim::engine
