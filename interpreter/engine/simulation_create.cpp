// SPDX-License-Identifier: MIT
#include <algorithm>

#include "engine/criterion_field.h"
#include "engine/integrators.h"
#include "engine/simulation.h"

namespace gmsim::engine {
namespace {

bool criteria_read_forces(const State& state, const Model& model) {
  return std::ranges::any_of(model.tears, [&](const TearPairing& tear) {
    return force_reads(state.program.criterion_bodies[tear.criterion], state.program.schema).any;
  });
}

}  // namespace

std::unique_ptr<Simulation> Simulation::create(State& state, Model model,
                                               IntegratorSettings settings,
                                               SimulationOptions options,
                                               support::Diagnostics& diagnostics) {
  if (auto problem = settings_problem(settings)) {
    diagnostics.report(std::move(*problem));
    return nullptr;
  }
  const ForceOptions force_options{.atomic = criteria_read_forces(state, model)};
  std::unique_ptr<ForceField> forces =
      options.tree_kernel
          ? make_tree_forces(state, model, diagnostics)
          : make_kernel_forces(state, model, options.threads, diagnostics, force_options);
  if (forces == nullptr) return nullptr;
  return create(state, std::move(model), std::move(settings), std::move(forces), options,
                diagnostics);
}

}  // namespace gmsim::engine
