// SPDX-License-Identifier: MIT
#include "engine/integrators/vertex_masses.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/tree_eval.h"

namespace gmsim::engine {
namespace {

const gmap::OrbitIndex& vertices(const State& state) {
  return state.store.index_of(*state.program.schema.find("position"));
}

support::Diagnostic unusable_mass(const State& state, Row row, double mass) {
  const char* const reason = mass == 0 ? "no mass" : mass < 0 ? "a negative mass" : "a mass that is no number";
  support::Diagnostic problem{support::DiagnosticKind::NoMass,
                              fmt::format("a particle that is free to move has {}", reason)};
  problem.notes.push_back(
      fmt::format("mass {} kg at {}", mass, vertex_text(state, vertices(state).smallest(row))));
  problem.help =
      "give every body a mass or a density, or fix the vertex; `mass` is the sum of `corner_mass`";
  return problem;
}

}  // namespace

std::vector<double> vertex_masses(const State& state, std::optional<support::Diagnostic>& problem) {
  const std::optional<EmbeddingId> mass = state.program.schema.find("mass");
  if (!mass) {
    problem = support::Diagnostic{support::DiagnosticKind::NoMass,
                                  "the rules declare no value `mass` on vertices"};
    return {};
  }
  const gmap::OrbitIndex& index = vertices(state);
  TreeEvaluator evaluator(state);
  std::vector<double> masses(index.row_end(), 0.0);
  for (Row row = 0; row < index.row_end(); ++row) {
    if (!index.alive(row)) continue;
    if (evaluator.read(*mass, index.smallest(row), {&masses[row], 1})) continue;
    problem = evaluator.take_failure().diagnostic;
    return {};
  }
  return masses;
}

std::vector<double> inverse_masses(const State& state, const std::vector<double>& masses,
                                   const std::vector<bool>& held,
                                   std::optional<support::Diagnostic>& problem) {
  const gmap::OrbitIndex& index = vertices(state);
  std::vector<double> inverse(masses.size(), 0.0);
  for (Row row = 0; row < masses.size(); ++row) {
    if (!index.alive(row) || held[row]) continue;
    if (!(masses[row] > 0) || !std::isfinite(1 / masses[row]) || !std::isfinite(masses[row])) {
      problem = unusable_mass(state, row, masses[row]);
      return {};
    }
    inverse[row] = 1 / masses[row];
  }
  return inverse;
}

std::string vertex_text(const State& state, DartId dart) {
  const std::span<const double> x =
      state.store.get(*state.program.schema.find("position"), dart);
  if (x.size() != 3) return fmt::format("the vertex of dart {}", types::index(dart));
  return fmt::format("vertex ({:.6g}, {:.6g}, {:.6g}), dart {}", x[0], x[1], x[2],
                     types::index(dart));
}

}  // namespace gmsim::engine
