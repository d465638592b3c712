// SPDX-License-Identifier: MIT
#include <utility>

#include "engine/simulation_implementation.h"
#include "support/check.h"

namespace gmsim::engine {
namespace {

EmbeddingId required(State& state, const char* name) {
  const std::optional<EmbeddingId> id = state.program.schema.find(name);
  GMSIM_CHECK(id.has_value(), std::string("no embedding `") + name + "` in the schema");
  state.store.use(*id);
  return *id;
}

VertexRecord record_of(std::span<const double> value) { return {value[0], value[1], value[2]}; }

}  // namespace

Simulation::Implementation::Implementation(State& state, Model model, IntegratorSettings settings,
                                           std::unique_ptr<ForceField> forces,
                                           SimulationOptions options)
    : state_(state),
      model_(std::move(model)),
      settings_(std::move(settings)),
      options_(options),
      info_(find_integrator(settings_.method)),
      position_(required(state, "position")),
      velocity_(required(state, "velocity")),
      forces_(std::move(forces)),
      equations_(*forces_, prescribed_),
      method_(make_integrator(*info_)),
      estimator_(*forces_, *method_),
      control_(method_->embedded_order()),
      masses_(state),
      steps_(state.step) {}

bool Simulation::Implementation::prepare(support::Diagnostics& diagnostics) {
  forces_->set_step(steps_);
  prescribed_ = PrescribedMotions(state_, model_.motions);
  if (settings_.dt > 0) prescribed_.set_step(settings_.dt);
  if (prescribed_.error()) {
    diagnostics.report(*prescribed_.error());
    return false;
  }
  if (!hold_vertices(diagnostics) || !weigh_vertices(diagnostics)) return false;
  load_motion();
  edges_ = EdgeLengths(state_, now_.motion);
  guard_ = Guard(edges_.shortest());
  if (!prescribe_now(diagnostics) || !find_limit(diagnostics) || !choose_step(diagnostics) ||
      !first_forces(diagnostics))
    return false;
  if (!model_.tears.empty() || !model_.rewrites.empty()) {
    if (forces_->context() == nullptr) {
      diagnostics.report({support::DiagnosticKind::NotAvailable,
                          "nothing can tear while forces are evaluated one match at a time"});
      return false;
    }
    changes_ = std::make_unique<MapChanges>(state_, model_, *forces_);
    for (const auto& field : changes_->criteria().fields())
      field->follow_nearest(options_.follow_nearest);
    if (!find_criteria(diagnostics)) return false;
  }
  for (support::Diagnostic& notice : forces_->notices(now_.motion, now_.time))
    diagnostics.report(std::move(notice));
  return !info_->adaptive || choose_first_step(diagnostics);
}

bool Simulation::Implementation::refresh(support::Diagnostics& diagnostics) {
  return adopt_map(diagnostics) && find_limit(diagnostics);
}

bool Simulation::Implementation::prescribe_now(support::Diagnostics& diagnostics) {
  prescribed_.begin_step(now_);
  if (equations_.prescribe(now_.time, now_.motion)) return true;
  diagnostics.report(*equations_.error());
  return false;
}

bool Simulation::Implementation::hold_vertices(support::Diagnostics& diagnostics) {
  fixed_.assign(vertices().row_end(), false);
  held_.assign(vertices().row_end(), false);
  for (Row row = 0; row < vertices().row_end(); ++row)
    if (!hold_vertex(row, diagnostics)) return false;
  return true;
}

bool Simulation::Implementation::hold_vertex(Row row, support::Diagnostics& diagnostics) {
  const std::optional<EmbeddingId> fixed = state_.program.schema.find("fixed");
  fixed_[row] = fixed && vertices().alive(row) && state_.store.in_use(*fixed) &&
                state_.store.get(*fixed, vertices().smallest(row))[0] != 0;
  held_[row] = fixed_[row] || prescribed_.moves(row);
  if (!fixed_[row] || !prescribed_.moves(row)) return true;
  support::Diagnostic problem{support::DiagnosticKind::Conflict,
                              "a vertex is both fixed and moved"};
  if (!model_.motions.empty()) problem.place = model_.motions.front().span;
  problem.notes.push_back(row_text(row));
  diagnostics.report(std::move(problem));
  return false;
}

bool Simulation::Implementation::weigh_vertices(support::Diagnostics& diagnostics) {
  std::optional<support::Diagnostic> problem;
  if (masses_.weigh_all(held_, problem)) {
    equations_.set_inverse_mass(masses_.inverse());
    return true;
  }
  diagnostics.report(std::move(*problem));
  return false;
}

void Simulation::Implementation::load_motion() {
  const Row rows = vertices().row_end();
  now_.resize(rows);
  method_->resize(rows);
  now_.time = state_.time;
  for (Row row = 0; row < rows; ++row) load_vertex(row);
  next_ = now_;
}

void Simulation::Implementation::load_vertex(Row row) {
  now_.motion.position[row] = now_.motion.velocity[row] = {};
  if (!vertices().alive(row)) return;
  now_.motion.position[row] = record_of(state_.store.column(position_).get(row));
  if (!fixed_[row])
    now_.motion.velocity[row] = record_of(state_.store.column(velocity_).get(row));
}

bool Simulation::Implementation::first_forces(support::Diagnostics& diagnostics) {
  if (!equations_.evaluate_forces(now_.motion, now_.time, dt_ / substeps_, now_.force, Stage::End)) {
    diagnostics.report(failed_forces(dt_));
    return false;
  }
  const Guard::Finding finding = Guard::look(now_);
  if (finding.finite) return true;
  diagnostics.report(diverged(dt_, "the state to start from is not finite", finding.row));
  return false;
}

}  // namespace gmsim::engine
