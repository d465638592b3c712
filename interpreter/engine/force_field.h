// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/model.h"
#include "engine/state.h"
#include "support/diagnostic.h"

namespace gmsim::engine {

/// A vertex quantity, padded to 32 bytes so that a vertex never straddles a cache line.
struct alignas(32) VertexRecord {
  double x = 0, y = 0, z = 0, w = 0;
};

/// The moving part of the state: one record per row of the vertex index, dead rows included.
struct Motion {
  std::vector<VertexRecord> position;  ///< m
  std::vector<VertexRecord> velocity;  ///< m/s
};

/// All forces of a model on all vertices. Two implementations: batched kernels, and the tree
/// oracle. Sums per vertex run in one canonical order (interaction, then match), whatever the number
/// of threads, so equal motions give equal bits.
class ForceField {
 public:
  virtual ~ForceField() = default;

  /// force[row] := sum of all forces on the vertex (N). False after a non-finite force; error()
  /// then says which rule, place and match.
  virtual bool evaluate(const Motion& motion, double time, double dt,
                        std::span<VertexRecord> force) = 0;
  /// Sum of all energies (J).
  virtual bool potential_energy(const Motion& motion, double time, double& energy) = 0;
  /// out[row] := (d force / d position) . dx + (d force / d velocity) . dv, for the stability
  /// estimate and later for implicit methods.
  virtual bool product(const Motion& motion, double time, std::span<const VertexRecord> dx,
                       std::span<const VertexRecord> dv, std::span<VertexRecord> out) = 0;
  /// For every match: the largest eigenvalue of its own stiffness against the corner masses it
  /// stands on (1/s^2), and likewise for damping (1/s): the bound that survives tearing.
  struct ElementBound {
    double stiffness = 0;
    double damping = 0;
    DartId where = gmap::kNoDart;
    std::uint32_t interaction = 0;
  };
  virtual bool element_bound(const Motion& motion, double time, ElementBound& bound) = 0;

  /// Does any force read velocities, or time?
  [[nodiscard]] virtual bool reads_velocity() const = 0;
  [[nodiscard]] virtual bool reads_time() const = 0;
  /// Takes over changed topology and values; `touched` as in Effects.
  virtual void refresh(std::span<const DartId> touched) = 0;
  [[nodiscard]] virtual const std::optional<support::Diagnostic>& error() const = 0;
  /// The plan as text (`gmsim explain`).
  [[nodiscard]] virtual std::string explain() const = 0;
};

/// Batched kernels over cached match tables (the engine that runs), on `threads` threads.
[[nodiscard]] std::unique_ptr<ForceField> make_kernel_forces(const State& state,
                                                             const Model& model, unsigned threads,
                                                             support::Diagnostics& diagnostics);
/// One match at a time from the specialised graphs, without blocks, tables or merging: the oracle.
[[nodiscard]] std::unique_ptr<ForceField> make_tree_forces(const State& state, const Model& model,
                                                           support::Diagnostics& diagnostics);

}  // namespace gmsim::engine
