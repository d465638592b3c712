// SPDX-License-Identifier: MIT
#include "engine/integrators/equations_of_motion.h"

namespace gmsim::engine {

bool EquationsOfMotion::evaluate(Motion& motion, double time, double dt,
                                 std::span<VertexRecord> force, Stage stage) {
  return prescribed_.apply(time, motion) && evaluate_forces(motion, time, dt, force, stage);
}

bool EquationsOfMotion::evaluate_forces(const Motion& motion, double time, double dt,
                                        std::span<VertexRecord> force, Stage stage) {
  ++evaluations_;
  return stage == Stage::End ? field_.evaluate_end(motion, time, dt, force)
                             : field_.evaluate(motion, time, dt, force);
}

const std::optional<support::Diagnostic>& EquationsOfMotion::error() const {
  return prescribed_.error() ? prescribed_.error() : field_.error();
}

}  // namespace gmsim::engine
