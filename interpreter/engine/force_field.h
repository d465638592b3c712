// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compile/dependence.h"
#include "engine/model.h"
#include "engine/state.h"
#include "support/diagnostic.h"

namespace gmsim::engine {

struct AtomicForce;
struct AtomicForceChanges;
struct ForceContext;

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
  /// The same at the end of a step, which is the state that criteria judge and where the next step
  /// begins. What ForceOptions asks for is kept from there.
  virtual bool evaluate_end(const Motion& motion, double time, double dt,
                            std::span<VertexRecord> force) {
    return evaluate(motion, time, dt, force);
  }
  /// The same after refresh(), at the motion of the last evaluate_end(), whose result is in `force`:
  /// computes what has changed.
  virtual bool evaluate_changes(const Motion& motion, double time, double dt,
                                std::span<VertexRecord> force) {
    return evaluate_end(motion, time, dt, force);
  }
  /// Sum of all energies (J).
  virtual bool potential_energy(const Motion& motion, double time, double& energy) = 0;
  /// out[row] := (d force / d position) . dx + (d force / d velocity) . dv, for the stability
  /// estimate and later for implicit methods.
  virtual bool product(const Motion& motion, double time, std::span<const VertexRecord> dx,
                       std::span<const VertexRecord> dv, std::span<VertexRecord> out) = 0;
  /// Upper bounds of the largest eigenvalue of the stiffness against the masses (1/s^2), and of the
  /// damping (1/s), from single elements and their corner masses: they stay bounds when elements
  /// are torn apart. `where` and `interaction` (index into Program::interactions) name a match in the
  /// stiffest element. Vertices that are `fixed` are left out.
  struct ElementBound {
    double stiffness = 0;
    double damping = 0;
    DartId where = gmap::kNoDart;
    std::uint32_t interaction = 0;
  };
  virtual bool element_bound(const Motion& motion, double time, ElementBound& bound) = 0;
  /// Warnings for matches where a vector between positions has no length, so that a force along it
  /// has no direction and is left out (a spring whose ends coincide); each interaction and orbit is
  /// named once in the life of this object. A pass of its own, so that evaluate() pays nothing for
  /// it; meant for the start and for frames: in between, ends that coincide exactly and part again
  /// have changed nothing that a user would see.
  virtual std::vector<support::Diagnostic> notices(const Motion& motion, double time) = 0;

  /// Steps completed, for forces and criteria that read `step`. The state has it only when it is in
  /// step with the simulation, which depends on the output.
  void set_step(std::uint64_t step) { step_ = static_cast<double>(step); }
  [[nodiscard]] double step() const { return step_; }

  /// Does any force read velocities, or the clock (time, dt, step)?
  [[nodiscard]] virtual bool reads_velocity() const = 0;
  [[nodiscard]] virtual bool reads_time() const = 0;

  // What criteria read, as ForceOptions asks for it; a field without a context keeps nothing.
  [[nodiscard]] virtual const ForceContext* context() const { return nullptr; }
  /// Appends every internal atomic force that is kept, in the canonical order.
  virtual void list_atomic(std::vector<AtomicForce>&) const {}
  /// What the last refresh() did to that list; null: it has to be read as a whole.
  [[nodiscard]] virtual const AtomicForceChanges* atomic_changes() const { return nullptr; }
  /// The forces of single matches on vertices (N), as the last evaluate_end() left them.
  [[nodiscard]] virtual std::span<const VertexRecord> atomic_slots() const { return {}; }

  /// The sum of all internal forces on each vertex (N), by row, as the last evaluate_end() left it.
  [[nodiscard]] virtual std::span<const VertexRecord> internal_sums() const { return {}; }

  /// work(context, begin, end) for disjoint ranges that make up the rows 0 … rows-1, on the threads
  /// that evaluate forces. What is written for a row may depend on nothing that is written for others.
  using RowWork = void (*)(const void* context, Row begin, Row end);
  virtual void share_rows(Row rows, RowWork work, const void* context) { work(context, 0, rows); }

  /// Takes over changed topology and values; `changed` as in MapDelta, empty when that is not known.
  virtual void refresh(std::span<const compile::Dependence> changed) = 0;
  /// Matches that refresh() has looked at again so far, without looking at all.
  [[nodiscard]] virtual std::uint64_t found_again() const { return 0; }
  [[nodiscard]] virtual const std::optional<support::Diagnostic>& error() const = 0;
  /// The plan as text (`gmsim explain`).
  [[nodiscard]] virtual std::string explain() const = 0;

 private:
  double step_ = 0;
};

struct ForceOptions {
  /// Add up matches between the same two vertices (parallel springs) where their forces are linear
  /// in what differs. Changes rounding, so it has to depend on rules and criteria alone.
  bool merge = true;
  // Of the ends of steps, for criteria:
  bool internal = false;  ///< keep the sums of internal forces on vertices
  bool atomic = false;    ///< keep the forces of single matches, each computed by itself
};

/// Batched kernels over cached match tables (the engine that runs), on `threads` threads.
[[nodiscard]] std::unique_ptr<ForceField> make_kernel_forces(const State& state,
                                                             const Model& model, unsigned threads,
                                                             support::Diagnostics& diagnostics,
                                                             ForceOptions options = {});
/// One match at a time from the specialised graphs, without blocks, tables or merging: the oracle.
[[nodiscard]] std::unique_ptr<ForceField> make_tree_forces(const State& state, const Model& model,
                                                           support::Diagnostics& diagnostics);

}  // namespace gmsim::engine
