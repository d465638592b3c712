// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/dart_pool.h"
#include "engine/frame.h"
#include "engine/quotient_filter.h"
#include "engine/state.h"
#include "engine/stored_values.h"
#include "engine/tree_eval.h"

namespace gmsim::engine {

/// The work of TreeEvaluator. Numbers are written to memory of the caller, so that nothing is
/// allocated but for collections, which come from a pool. After a failure every function returns
/// something harmless, loops stop, and the first failure is kept.
class TreeWalker {
 public:
  explicit TreeWalker(const State& state) : state_(state), stored_(state), filter_(state) {}

  /// Enters an expression with the locals of `frame`.
  class Entry {
   public:
    Entry(TreeWalker& walker, Frame& frame) : walker_(walker), outer_(walker.frame_) {
      if (outer_ == nullptr) walker.stored_.update();
      walker.frame_ = &frame;
    }
    ~Entry() { walker_.frame_ = outer_; }
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;

   private:
    TreeWalker& walker_;
    Frame* outer_;
  };

  void numbers(const types::Expr& expr, double* out);
  [[nodiscard]] double scalar(const types::Expr& expr);
  [[nodiscard]] DartId dart(const types::Expr& expr);
  void darts(const types::Expr& expr, std::vector<DartId>& out);
  void assign(const types::Expr& expr, Slot slot);
  void read(EmbeddingId id, DartId dart, double* out, const types::Expr* reader);

  /// As TreeEvaluator::read_forces().
  void read_forces(const AtomicForceReader* forces) { forces_ = forces; }

  [[nodiscard]] bool failed() const { return failure_.has_value(); }
  [[nodiscard]] EvalFailure take_failure();

 private:
  using Expr = types::Expr;

  // tree_walker.cpp
  void fail(support::DiagnosticKind kind, const Expr& where, std::string message,
            std::string help = {});
  void fail_missing(EmbeddingId id, DartId dart, const Expr* reader);
  [[nodiscard]] bool live_dart(const Expr& expr, DartId& out);
  /// Where the components of a value are: its home when it has one, else `scratch`.
  [[nodiscard]] const double* view(const Expr& expr, double* scratch);
  /// Calls body() with the slot of a Let bound to its value.
  template <typename Body>
  void with_bound(const Expr& let, const Body& body);
  void unavailable(const Expr& expr);
  [[nodiscard]] const Expr& branch(const Expr& choice);
  void derived(EmbeddingId id, DartId dart, double* out);
  [[nodiscard]] bool has(const Expr& expr);
  [[nodiscard]] std::uint32_t element_offset(const Expr& index);

  // tree_arithmetic.cpp
  [[nodiscard]] bool truth(const Expr& expr) { return scalar(expr) != 0.0; }
  [[nodiscard]] double scalar_arithmetic(const Expr& expr);
  void arithmetic(const Expr& expr, double* out);
  void operand(const Expr& expr, std::uint32_t count, double* out);
  void sum_or_difference(const Expr& expr, double* out);
  void product(const Expr& expr, double* out);
  [[nodiscard]] bool equal(const Expr& expr);
  void convert(const Expr& expr, double* out);
  void call(const Expr& expr, double* out);

  // tree_collections.cpp
  void quotient(const Expr& expr, std::vector<DartId>& out);
  void polygon(const Expr& expr, std::vector<DartId>& out);
  /// Calls body() with the fold's variable set to each member; stops when body returns false.
  template <typename Body>
  void each(const Expr& fold, const Body& body);
  void fold(const Expr& expr, double* out);
  void fold_sum(const Expr& expr, double* out);
  void fold_extreme(const Expr& expr, double* out);
  [[nodiscard]] double fold_truth(const Expr& expr);
  [[nodiscard]] double fold_count(const Expr& expr);
  /// Calls body() with the variable set to the member of the best key.
  template <typename Body>
  void fold_best(const Expr& expr, const Body& body);
  [[nodiscard]] DartId fold_dart(const Expr& expr);
  void fail_empty(const Expr& expr);

  // tree_atomic_forces.cpp
  void force_on(const Expr& expr, double* out);
  /// The forces of a collection, as numbers of a vector.
  [[nodiscard]] std::vector<std::array<double, 3>> atomic_forces(const Expr& collection);

  const State& state_;
  const AtomicForceReader* forces_ = nullptr;
  StoredValues stored_;
  QuotientFilter filter_;
  Frame* frame_ = nullptr;
  std::deque<Frame> derived_frames_;
  std::size_t derived_depth_ = 0;
  DartPool pool_;
  std::optional<EvalFailure> failure_;
};

template <typename Body>
void TreeWalker::with_bound(const Expr& let, const Body& body) {
  const Expr& bound = *let.args[0];
  const Arena::Mark mark = frame_->arena_.mark();
  const DartPool::Lease collection(pool_);
  Frame::Cell value;
  switch (bound.type.kind) {
    case types::ValueKind::Dart:
      value.kind = Frame::Kind::Dart;
      value.dart = dart(bound);
      break;
    case types::ValueKind::Darts:
      value.kind = Frame::Kind::Darts;
      value.darts = &*collection;
      darts(bound, *collection);
      break;
    default:
      value.kind = Frame::Kind::Numbers;
      value.count = types::number_count(bound.type);
      value.numbers = frame_->arena_.allocate(value.count);
      numbers(bound, value.numbers);
  }
  const Frame::Cell outer = std::exchange(frame_->cell(let.slot), value);
  body();
  frame_->cell(let.slot) = outer;
  frame_->arena_.release(mark);
}

}  // namespace gmsim::engine
