// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/frame.h"
#include "engine/state.h"
#include "support/diagnostic.h"

namespace gmsim::engine {

/// Why an expression has no value.
struct EvalFailure {
  /// The read value is optional and the orbit has none: the reader does not hold there, which is
  /// no error for a `where` (language, parameters).
  bool missing_optional = false;
  support::Diagnostic diagnostic;
};

class TreeWalker;
struct AtomicForceReader;

/// Evaluates checked expressions on a state, one at a time, straight from the tree: slow, simple,
/// and the reference for anything faster. Collections are visited by ascending smallest dart and
/// sums added in that order. A function argument (Let) is evaluated once, before its body.
///
/// After a failure results are meaningless until take_failure(); the first failure is kept.
class TreeEvaluator {
 public:
  explicit TreeEvaluator(const State& state);
  ~TreeEvaluator();
  TreeEvaluator(const TreeEvaluator&) = delete;
  TreeEvaluator& operator=(const TreeEvaluator&) = delete;

  /// A storable value, component_count(expr.type) doubles. False after a failure.
  bool evaluate(const types::Expr& expr, Frame& frame, std::span<double> out);
  bool evaluate_bool(const types::Expr& expr, Frame& frame, bool& out);
  bool evaluate_dart(const types::Expr& expr, Frame& frame, DartId& out);
  bool evaluate_darts(const types::Expr& expr, Frame& frame, std::vector<DartId>& out);
  /// A value of any type, empty after a failure.
  [[nodiscard]] std::optional<types::Value> evaluate(const types::Expr& expr, Frame& frame);
  /// Puts the value of `expr`, of any type, into a slot.
  bool assign(const types::Expr& expr, types::Slot slot, Frame& frame);

  /// The value of any embedding at a dart, stored, derived or default.
  bool read(EmbeddingId id, DartId dart, std::span<double> out);

  /// What force_on() and forces() read from now on; null: they are not available.
  void read_forces(const AtomicForceReader* forces);

  [[nodiscard]] bool failed() const;
  /// The first failure since the last call; there must be one.
  [[nodiscard]] EvalFailure take_failure();

 private:
  std::unique_ptr<TreeWalker> walker_;
};

/// Uniform in [0, 1): a hash of the expression's seed, the scene's seed, the orbit type and the
/// creation number of the orbit, which is the id of its smallest, that is oldest, dart. So the
/// number depends on the map alone and stays while that dart lives.
[[nodiscard]] double random_number(std::int64_t seed, const State& state, OrbitType type,
                                   DartId dart);

}  // namespace gmsim::engine
