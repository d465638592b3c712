// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "compile/program.h"
#include "engine/effects.h"
#include "engine/matcher.h"
#include "engine/state.h"
#include "support/diagnostic.h"

namespace gmsim::engine {

/// The result of applying a rule or an operation. Unless Applied, the state is bitwise as before.
struct RewriteOutcome {
  enum class Status : std::uint8_t {
    Applied,
    NotMatched,  ///< the pattern does not hold there, or a condition is false: see `failure`;
                 ///< an operation also says in `error` which rule did not match where
    Failed       ///< see `error`
  };
  Status status = Status::Applied;
  MatchFailure failure;
  std::optional<support::Diagnostic> error = std::nullopt;
  Effects effects;

  [[nodiscard]] bool applied() const { return status == Status::Applied; }
};

struct RewriteOptions {
  MatcherKind matcher = MatcherKind::Planned;
  bool validate = false;  ///< check the map and the store after every rewrite
};

class Rewriter;

/// Called for every created orbit of an embedding in use that marks an interaction (role Presence),
/// on the new map, after the rule's own values are stored: who owns the scene gives the mark and
/// the parameters that the rule did not (`state.store.get` is empty) by Rewriter::set_value. An
/// error undoes the rewrite.
using CreatedOrbitHook = std::function<std::optional<support::Diagnostic>(
    Rewriter&, EmbeddingId presence, DartId smallest)>;

/// Applies rules to a state (docs/theory.md, application): expressions on the old map, topology,
/// orbit repair, values. All or nothing, each application by itself or, between begin() and
/// commit() or roll_back(), all of them together.
class Rewriter {
  class Implementation;

 public:
  explicit Rewriter(State& state, RewriteOptions options = {});
  ~Rewriter();
  Rewriter(const Rewriter&) = delete;
  Rewriter& operator=(const Rewriter&) = delete;

  /// Applies at given hook darts, one for each hook of the rule.
  RewriteOutcome apply(const compile::Rule& rule, std::span<const DartId> hooks,
                       const Arguments& arguments = {});
  /// The same, adding what it does to the effects in `outcome`.
  void apply(const compile::Rule& rule, std::span<const DartId> hooks, const Arguments& arguments,
             RewriteOutcome& outcome);
  /// Applies at each of the darts in turn (one-hook rules), matching again when its turn comes;
  /// what no longer matches is counted in `effects.dropped`. Stops at the first error, before
  /// which everything stays applied.
  RewriteOutcome apply_each(const compile::Rule& rule, std::span<const DartId> darts,
                            const Arguments& arguments = {});
  /// A rule that changes values only, at all the darts at once: reads the old state everywhere,
  /// then writes; different values for one orbit are an error (E7).
  RewriteOutcome apply_at_once(const compile::Rule& rule, std::span<const DartId> darts,
                               const Arguments& arguments = {});
  /// At once for a rule that changes values only, else in turn.
  RewriteOutcome apply_everywhere(const compile::Rule& rule, std::span<const DartId> darts,
                                  const Arguments& arguments = {});

  /// Everything from here on is undone together. Does not nest.
  void begin();
  void commit();
  void roll_back();
  [[nodiscard]] bool recording() const;

  /// Stores a value at the orbit of a dart, undone with the rest.
  void set_value(EmbeddingId id, DartId dart, std::span<const double> value);

  void on_created(CreatedOrbitHook hook);
  [[nodiscard]] State& state();
  [[nodiscard]] Matcher& matcher();

 private:
  std::unique_ptr<Implementation> implementation_;
};

/// "rule `separate_elements` cannot be applied at a = dart 5: there is no link `a -2- b`".
[[nodiscard]] support::Diagnostic not_matched(const compile::Rule& rule,
                                              std::span<const DartId> hooks,
                                              const MatchFailure& failure);

}  // namespace gmsim::engine
