// SPDX-License-Identifier: MIT
#include "engine/criterion_field.h"
#include "engine/integrators.h"
#include "engine/simulation.h"

namespace gmsim::engine {
namespace {

ForceOptions options_for_criteria(const State& state, const Model& model) {
  ForceOptions options;
  const auto vertex = types::OrbitType::cell(0, state.map.dimension());
  for (const TearPairing& tear : model.tears) {
    const ForceReads reads = force_reads(tear, state.program, vertex);
    options.internal = options.internal || reads.internal;
    options.atomic = options.atomic || reads.single;
  }
  return options;
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
  std::unique_ptr<ForceField> forces =
      options.tree_kernel
          ? make_tree_forces(state, model, diagnostics)
          : make_kernel_forces(state, model, options.threads, diagnostics,
                               options_for_criteria(state, model));
  if (forces == nullptr) return nullptr;
  return create(state, std::move(model), std::move(settings), std::move(forces), options,
                diagnostics);
}

}  // namespace gmsim::engine
