// SPDX-License-Identifier: MIT
#include "engine/simulation.h"

#include <utility>

#include "engine/integrators.h"
#include "engine/simulation_implementation.h"
#include "support/check.h"

namespace gmsim::engine {

Simulation::Simulation(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}
Simulation::~Simulation() = default;

std::unique_ptr<Simulation> Simulation::create(State& state, Model model,
                                               IntegratorSettings settings,
                                               std::unique_ptr<ForceField> forces,
                                               SimulationOptions options,
                                               support::Diagnostics& diagnostics) {
  if (auto problem = settings_problem(settings)) {
    diagnostics.report(std::move(*problem));
    return nullptr;
  }
  auto implementation = std::make_unique<Implementation>(
      state, std::move(model), std::move(settings), std::move(forces), options);
  if (!implementation->prepare(diagnostics)) return nullptr;
  return std::unique_ptr<Simulation>(new Simulation(std::move(implementation)));
}

std::optional<StepReport> Simulation::step(double until, support::Diagnostics& diagnostics) {
  GMSIM_CHECK(until > time(), "a step must end after it begins");
  return implementation_->step(until, diagnostics);
}
double Simulation::time() const { return implementation_->time(); }
std::uint64_t Simulation::steps() const { return implementation_->steps(); }
std::uint64_t Simulation::evaluations() const { return implementation_->evaluations(); }
double Simulation::dt() const { return implementation_->dt(); }
void Simulation::dense_positions(double time, std::vector<double>& out) const {
  implementation_->dense_positions(time, out);
}
Totals Simulation::totals() { return implementation_->totals(); }
const StabilityLimit& Simulation::limit() const { return implementation_->limit(); }
double Simulation::max_elongation() const { return implementation_->max_elongation(); }
void Simulation::sync() { implementation_->sync(); }
bool Simulation::refresh(support::Diagnostics& diagnostics) {
  return implementation_->refresh(diagnostics);
}
std::optional<std::vector<Simulation::CriterionReport>> Simulation::survey(
    support::Diagnostics& diagnostics) {
  return implementation_->survey(diagnostics);
}
std::uint64_t Simulation::state_hash() const { return implementation_->state_hash(); }
std::string Simulation::explain() const { return implementation_->explain(); }

}  // namespace gmsim::engine
