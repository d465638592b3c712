// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "engine/atomic_forces.h"
#include "engine/force_field.h"

namespace gmsim::engine {

/// The internal forces on the state in the store, for what is looked at besides the run: output
/// fields, expectations. Evaluated by itself, so that looking changes nothing.
class ForceProbe {
 public:
  /// `model`: of the simulation of this state. Null after an error, which is reported.
  [[nodiscard]] static std::unique_ptr<ForceProbe> create(const State& state, const Model& model,
                                                          support::Diagnostics& diagnostics);

  /// Evaluates the forces at the positions, velocities and clock of the store. False after an error.
  bool update(support::Diagnostics& diagnostics);
  /// What the last update() found, for TreeEvaluator::read_forces().
  [[nodiscard]] const AtomicForceReader& forces() const { return reader_; }

 private:
  ForceProbe(const State& state, const Model& model, std::unique_ptr<ForceField> field);
  void load_motion();

  const State& state_;
  const bool map_changes_;
  std::unique_ptr<ForceField> field_;
  AtomicForceIndex index_;
  AtomicForceReader reader_;
  Motion motion_;
  std::vector<VertexRecord> force_;
  bool listed_ = false;
};

}  // namespace gmsim::engine
