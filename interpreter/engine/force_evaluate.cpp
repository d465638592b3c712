// SPDX-License-Identifier: MIT
#include "engine/force_evaluate.h"

#include <array>

#include "engine/force_readings.h"

namespace gmsim::engine {

void evaluate_match(const ForceProgram& program, const ForceMatch& match, const ForceMoment& moment,
                    const gmap::EmbeddingStore& store, IrEvaluator<double>& evaluator) {
  using Kind = InputOrigin::Kind;
  for (const auto& [input, origin] : program.inputs) {
    const auto set = [&, number = input](std::span<const double> entries) {
      evaluator.set_input(number, entries);
    };
    const auto row = [&, role = origin.role] { return match.roles.roles[role].row; };
    const auto set_vector = [&](std::span<const VertexRecord> records) {
      const VertexRecord& record = records[row()];
      set(std::array{record.x, record.y, record.z});
    };
    switch (origin.kind) {
      case Kind::Position: set_vector(moment.position); break;
      case Kind::Velocity: set_vector(moment.velocity); break;
      case Kind::PositionChange: set_vector(moment.position_change); break;
      case Kind::VelocityChange: set_vector(moment.velocity_change); break;
      case Kind::Column:
        set(store.column(origin.embedding).get(row()).subspan(origin.offset, origin.width));
        break;
      case Kind::Own: set({match.own.data() + origin.offset, origin.width}); break;
      case Kind::ForceOn:
        set_vector(moment.forces->values(origin.orbit, origin.offset));
        break;
      case Kind::AtomicForce: set_vector(moment.forces->atomic); break;
      case Kind::Time: set({&moment.time, 1}); break;
      case Kind::Dt: set({&moment.dt, 1}); break;
      case Kind::Step: set({&moment.step, 1}); break;
    }
  }
  evaluator.run();
}

}  // namespace gmsim::engine
