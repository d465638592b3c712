// SPDX-License-Identifier: MIT
#include "engine/integrators/vertex_masses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/force_watch.h"

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

bool VertexMasses::weigh_all(const std::vector<bool>& held,
                             std::optional<support::Diagnostic>& problem) {
  const Row rows = vertices(state_).row_end();
  masses_.assign(rows, 0.0);
  inverse_.assign(rows, 0.0);
  for (Row row = 0; row < rows; ++row)
    if (!weigh(row, held[row], problem)) return false;
  return true;
}

bool VertexMasses::weigh(std::span<const Row> rows, const std::vector<bool>& held,
                         std::optional<support::Diagnostic>& problem) {
  masses_.resize(vertices(state_).row_end());
  inverse_.resize(masses_.size());
  return std::all_of(rows.begin(), rows.end(),
                     [&](Row row) { return weigh(row, held[row], problem); });
}

bool VertexMasses::weigh(Row row, bool held, std::optional<support::Diagnostic>& problem) {
  const std::optional<EmbeddingId> mass = state_.program.schema.find("mass");
  if (!mass) {
    problem = support::Diagnostic{support::DiagnosticKind::NoMass,
                                  "the rules declare no value `mass` on vertices"};
    return false;
  }
  masses_[row] = inverse_[row] = 0;
  if (!vertices(state_).alive(row)) return true;
  if (!evaluator_.read(*mass, vertices(state_).smallest(row), {&masses_[row], 1})) {
    problem = evaluator_.take_failure().diagnostic;
    return false;
  }
  if (held) return true;
  if (!(masses_[row] > 0) || !std::isfinite(1 / masses_[row]) || !std::isfinite(masses_[row])) {
    problem = unusable_mass(state_, row, masses_[row]);
    return false;
  }
  inverse_[row] = 1 / masses_[row];
  return true;
}

bool VertexMasses::local() const {
  const std::optional<EmbeddingId> mass = state_.program.schema.find("mass");
  return !mass || stays_in_orbit(state_.program.schema, *mass);
}

std::string vertex_text(const State& state, DartId dart) {
  const std::span<const double> x =
      state.store.get(*state.program.schema.find("position"), dart);
  if (x.size() != 3) return fmt::format("the vertex of dart {}", types::index(dart));
  return fmt::format("vertex ({:.6g}, {:.6g}, {:.6g}), dart {}", x[0], x[1], x[2],
                     types::index(dart));
}

}  // namespace gmsim::engine
