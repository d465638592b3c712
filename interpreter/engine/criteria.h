// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/criterion_field.h"
#include "engine/force_field.h"
#include "engine/map_delta.h"

namespace gmsim::engine {

/// The criteria of a model at work: judged everywhere on one state, before anything changes.
class Criteria {
 public:
  using Diagnostic = std::optional<support::Diagnostic>;

  /// `forces` must know its context (ForceField::context). Makes the orbit indices that sums need.
  Criteria(State& state, const ForceField& forces, std::span<const TearPairing> pairings);

  /// Finds all matches and force lists anew.
  Diagnostic rebuild();
  /// Follows a change of the map, which the force field has followed already; counts in `looked_at`
  /// the matches that were found again.
  Diagnostic repair(const Effects& effects, const MapDelta& delta, std::uint64_t& looked_at);
  /// The requests of all pairings that are due at `time`, those of each pairing reduced to its
  /// strongest, in the order of their application. The last evaluation of the force field must have
  /// been of this motion. `sync` puts it into the store; it is called, once, before `where` is looked
  /// at and whenever there are requests.
  Diagnostic judge(const Motion& motion, double time, double dt, const std::function<void()>& sync,
                   std::vector<TearRequest>& requests);

  [[nodiscard]] const std::vector<std::unique_ptr<CriterionField>>& fields() const {
    return fields_;
  }

 private:
  void list_forces();
  /// Makes the sums that are not there yet, and sees what is read one by one.
  void add_readings();
  void update_sums(const Effects& effects, const MapDelta& delta);
  void read_forces_now();
  /// Drops what the scene does not allow, keeps the strongest, and adds a request for each node.
  Diagnostic select(const CriterionField& field, std::vector<TearRequest>& requests);
  /// Does the scene let it tear there?
  [[nodiscard]] bool allowed(const TearPairing& pairing, DartId hook, Diagnostic& error);

  State& state_;
  const ForceField& forces_;
  AtomicForceIndex atomic_;
  compile::World world_;
  ForceReadings readings_;
  bool one_by_one_ = false;
  std::vector<std::unique_ptr<CriterionField>> fields_;
  AtomicForceReader reader_{&atomic_, {}};  // what `where` reads
  TreeEvaluator evaluator_;
  std::vector<AtomicForce> listed_;
  // Work space of repairs.
  std::vector<DartId> relisted_;  // darts with other lists of forces than before
  std::vector<DartId> summed_;    // darts of orbits whose sums are others
  std::vector<compile::Dependence> with_lists_;
};

}  // namespace gmsim::engine
