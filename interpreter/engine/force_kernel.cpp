// SPDX-License-Identifier: MIT
#include "engine/force_kernel.h"

#include <algorithm>
#include <utility>

#include "engine/force_readings.h"
#include "support/check.h"

namespace gmsim::engine {

namespace {

const double* numbers(std::span<const VertexRecord> records) {
  return records.empty() ? nullptr : &records.front().x;
}

}  // namespace

ForceKernel::ForceKernel(ForceProgram program)
    : program_(std::move(program)),
      kernel_(compile::compile_kernel(program_.graph, program_.roots)) {
  for (const compile::KernelInput& input : kernel_.inputs) {
    const auto live = std::find_if(program_.inputs.begin(), program_.inputs.end(),
                                   [&](const auto& l) { return l.number == input.input; });
    GMSIM_CHECK(live != program_.inputs.end(), "a kernel reads an input that nobody knows");
    origins_.push_back(live->origin);
  }
}

InputBinding ForceKernel::binding(const InputOrigin& origin, const MatchTable& table,
                                  const gmap::EmbeddingStore& store,
                                  const ForceMoment& moment) const {
  using Kind = InputOrigin::Kind;
  constexpr std::uint32_t kRecord = sizeof(VertexRecord) / sizeof(double);
  const auto vertex = [&](const std::span<const VertexRecord> records) {
    return InputBinding{numbers(records), kRecord, table.rows(origin.role).data(), true};
  };
  switch (origin.kind) {
    case Kind::Position: return vertex(moment.position);
    case Kind::Velocity: return vertex(moment.velocity);
    case Kind::PositionChange: return vertex(moment.position_change);
    case Kind::VelocityChange: return vertex(moment.velocity_change);
    case Kind::Column: {
      const gmap::EmbeddingColumn& column = store.column(origin.embedding);
      return {column.data().data() + origin.offset, column.stride(),
              table.rows(origin.role).data(), true};
    }
    case Kind::Own: {
      const MatchTable::OwnColumn own = table.own(origin.offset);
      return {own.begin, own.stride, nullptr, true};
    }
    case Kind::ForceOn: {
      const OrbitForces* sum = moment.forces->find(origin.orbit, origin.offset);
      return {numbers(sum->values()), kRecord, table.rows(origin.role).data(), true};
    }
    case Kind::AtomicForce: return vertex(moment.forces->atomic);
    case Kind::Time: return {&moment.time};
    case Kind::Dt: return {&moment.dt};
    case Kind::Step: return {&moment.step};
  }
  return {};
}

void ForceKernel::bind(const MatchTable& table, const gmap::EmbeddingStore& store,
                       const ForceMoment& moment, std::vector<InputBinding>& bindings) const {
  bindings.clear();
  for (const InputOrigin& origin : origins_)
    bindings.push_back(binding(origin, table, store, moment));
}

}  // namespace gmsim::engine
