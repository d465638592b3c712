// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/criterion_field.h"
#include "engine/force_field.h"

namespace gmsim::engine {

/// The criteria of a model at work: judged everywhere on one state, before anything changes.
class Criteria {
 public:
  using Diagnostic = std::optional<support::Diagnostic>;

  /// `forces` must know its context (ForceField::context). Makes the orbit indices that sums need.
  Criteria(State& state, const ForceField& forces, std::span<const TearPairing> pairings);

  /// Finds all matches and force lists anew.
  Diagnostic rebuild();
  /// The requests of all pairings that are due at `time`, those of each pairing reduced to its
  /// strongest, in the order of their application. The last evaluation of the force field must have
  /// been of this motion; the store must hold its positions if `where` of a pairing reads them.
  Diagnostic judge(const Motion& motion, double time, double dt,
                   std::vector<TearRequest>& requests);

  /// Does any criterion read forces?
  [[nodiscard]] bool read_forces() const { return !readings_.sums.empty() || one_by_one_; }
  [[nodiscard]] const std::vector<std::unique_ptr<CriterionField>>& fields() const {
    return fields_;
  }

 private:
  void read_forces_now();
  /// Drops what the scene does not allow, keeps the strongest, and adds a request for each node.
  Diagnostic select(const CriterionField& field, std::vector<TearRequest>& requests);

  State& state_;
  const ForceField& forces_;
  AtomicForceIndex atomic_;
  compile::World world_;
  ForceReadings readings_;
  bool one_by_one_ = false;
  std::vector<std::unique_ptr<CriterionField>> fields_;
  TreeEvaluator evaluator_;
  std::vector<AtomicForce> listed_;
};

}  // namespace gmsim::engine
