// SPDX-License-Identifier: MIT
#include "engine/force_probe.h"

#include <utility>

#include "engine/force_context.h"

namespace gmsim::engine {

std::unique_ptr<ForceProbe> ForceProbe::create(const State& state, const Model& model,
                                               support::Diagnostics& diagnostics) {
  auto field = make_kernel_forces(state, model, 1, diagnostics, {.atomic = true});
  if (field == nullptr) return nullptr;
  return std::unique_ptr<ForceProbe>(new ForceProbe(state, model, std::move(field)));
}

ForceProbe::ForceProbe(const State& state, const Model& model, std::unique_ptr<ForceField> field)
    : state_(state),
      map_changes_(!model.tears.empty() || !model.rewrites.empty()),
      field_(std::move(field)),
      index_(state.map),
      reader_{&index_, {}} {}

bool ForceProbe::update(support::Diagnostics& diagnostics) {
  if (map_changes_ && listed_) {
    field_->refresh({});
    listed_ = false;
  }
  load_motion();
  field_->set_step(state_.step);
  const bool good = !field_->error() &&
                    field_->evaluate_end(motion_, state_.time, state_.dt, force_);
  if (!good) {
    diagnostics.report(*field_->error());
    return false;
  }
  if (!std::exchange(listed_, true)) {
    std::vector<AtomicForce> forces;
    field_->list_atomic(forces);
    index_.rebuild(forces);
  }
  reader_.slots = field_->atomic_slots();
  return true;
}

void ForceProbe::load_motion() {
  const gmap::OrbitIndex& vertices = field_->context()->vertices();
  const gmap::EmbeddingSchema& schema = state_.program.schema;
  motion_.position.resize(vertices.row_end());
  motion_.velocity.resize(vertices.row_end());
  force_.resize(vertices.row_end());
  const auto load = [&](const char* name, std::vector<VertexRecord>& records) {
    const auto id = schema.find(name);
    if (!id || !state_.store.in_use(*id)) return;
    const gmap::EmbeddingColumn& column = state_.store.column(*id);
    for (Row row = 0; row < records.size(); ++row) {
      if (!vertices.alive(row) || !column.has(row)) continue;
      const std::span<const double> value = column.get(row);
      records[row] = {value[0], value[1], value[2], 0};
    }
  };
  load("position", motion_.position);
  load("velocity", motion_.velocity);
}

}  // namespace gmsim::engine
