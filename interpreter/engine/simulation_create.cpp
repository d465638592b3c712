// SPDX-License-Identifier: MIT
#include "engine/integrators.h"
#include "engine/simulation.h"

namespace gmsim::engine {

std::unique_ptr<Simulation> Simulation::create(State& state, Model model,
                                               IntegratorSettings settings,
                                               SimulationOptions options,
                                               support::Diagnostics& diagnostics) {
  if (auto problem = settings_problem(settings)) {
    diagnostics.report(std::move(*problem));
    return nullptr;
  }
  std::unique_ptr<ForceField> forces =
      options.tree_kernel ? make_tree_forces(state, model, diagnostics)
                          : make_kernel_forces(state, model, options.threads, diagnostics);
  if (forces == nullptr) return nullptr;
  return create(state, std::move(model), std::move(settings), std::move(forces), options,
                diagnostics);
}

}  // namespace gmsim::engine
