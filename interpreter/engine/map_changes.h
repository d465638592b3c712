// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/criteria.h"
#include "engine/model.h"
#include "engine/new_interactions.h"
#include "engine/tearing.h"

namespace gmsim::engine {

/// What happens to the map at the end of a step: the rewrites of every step, then what criteria ask for.
class MapChanges {
 public:
  using Diagnostic = std::optional<support::Diagnostic>;

  MapChanges(State& state, const Model& model, const ForceField& forces);

  /// Finds the matches of all criteria anew: at the start and after every change of the map.
  Diagnostic rebuild() { return criteria_.rebuild(); }
  /// The same where the map changed.
  Diagnostic repair(const Effects& effects, const MapDelta& delta, std::uint64_t& looked_at) {
    return criteria_.repair(effects, delta, looked_at);
  }

  /// Applies the rewrites of every step; the store must be in step with the motion.
  Diagnostic rewrite(Effects& effects);
  [[nodiscard]] bool has_rewrites() const { return !model_.rewrites.empty(); }
  [[nodiscard]] bool has_criteria() const { return !model_.tears.empty(); }

  /// Judges all criteria, which the last evaluation of forces must have been for. `sync` puts the
  /// motion into the store, which happens only if something is asked for.
  Diagnostic judge(const Motion& motion, double time, double dt, const std::function<void()>& sync,
                   std::uint32_t pass);
  /// Applies what they ask for. Of pairings with `refresh` only the strongest request, with its ties,
  /// is applied; as long as that changes something, another pass follows, for them alone, on the
  /// forces of the new map.
  Diagnostic tear(TearOutcome& outcome);
  [[nodiscard]] bool judges_again() const;

  [[nodiscard]] Criteria& criteria() { return criteria_; }

 private:
  Diagnostic run_rewrite(const StandingRewrite& rewrite, Effects& effects);
  /// Darts at which a rewrite is tried: one for each orbit of `to` that `where` allows.
  Diagnostic find_candidates(const StandingRewrite& rewrite, std::vector<DartId>& darts);
  Diagnostic evaluate_arguments(const StandingRewrite& rewrite, Arguments& arguments);
  /// Drops requests that have no turn in this pass.
  void drop_spent(std::uint32_t pass);
  /// Moves what is applied before anything is judged again from requests_ to batch_.
  void take_batch();
  /// Holds that do not pass to all parts of a split vertex.
  void release_holds(const Effects& effects);

  State& state_;
  const Model& model_;
  Criteria criteria_;
  NewInteractions new_interactions_;
  Rewriter rewriter_;
  Tearing tearing_;
  TreeEvaluator evaluator_;
  std::vector<std::vector<DartId>> holds_;  // darts of the vertex of each of model_.holds
  std::vector<TearRequest> requests_, batch_;
  std::vector<std::uint32_t> applied_;  // by pairing, in this step
};

}  // namespace gmsim::engine
