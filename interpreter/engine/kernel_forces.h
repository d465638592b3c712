// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "engine/atomic_forces.h"
#include "engine/force_bound.h"
#include "engine/force_context.h"
#include "engine/force_field.h"
#include "engine/force_pass.h"
#include "engine/force_tables.h"

namespace gmsim::engine {

/// Finds out on the first evaluations whether sharing the work pays. Whatever it says, the forces have
/// the same bits.
class ThreadProbe {
 public:
  [[nodiscard]] bool decided() const { return runs_ == 2 * kRuns; }
  /// Is the next evaluation to be run by one thread?
  [[nodiscard]] bool alone() const { return decided() ? alone_is_faster_ : runs_ % 2 == 0; }
  void note(double seconds);

 private:
  static constexpr int kRuns = 9;  // of each kind; the median counts

  int runs_ = 0;
  bool alone_is_faster_ = true;  // when decided
  std::array<std::array<double, kRuns>, 2> seconds_{};  // alone, shared
};

/// Forces by kernels over match tables. Where criteria read single forces there are two passes: one
/// for sums alone, and one that keeps the forces, for the ends of steps.
class KernelForces final : public ForceField {
 public:
  KernelForces(const State& state, const Model& model, unsigned threads, ForceOptions options);

  bool evaluate(const Motion& motion, double time, double dt,
                std::span<VertexRecord> force) override;
  bool evaluate_end(const Motion& motion, double time, double dt,
                    std::span<VertexRecord> force) override;
  bool evaluate_changes(const Motion& motion, double time, double dt,
                        std::span<VertexRecord> force) override;
  bool potential_energy(const Motion& motion, double time, double& energy) override;
  bool product(const Motion& motion, double time, std::span<const VertexRecord> dx,
               std::span<const VertexRecord> dv, std::span<VertexRecord> out) override;
  bool element_bound(const Motion& motion, double time, ElementBound& bound) override;
  std::vector<support::Diagnostic> notices(const Motion& motion, double time) override;
  [[nodiscard]] bool reads_velocity() const override {
    return reads(InputOrigin::Kind::Velocity);
  }
  [[nodiscard]] bool reads_time() const override;
  void share_rows(Row rows, RowWork work, const void* context) override;
  void refresh(std::span<const compile::Dependence> changed) override;
  [[nodiscard]] std::uint64_t found_again() const override { return found_again_; }
  [[nodiscard]] const ForceContext* context() const override { return &context_; }
  void list_atomic(std::vector<AtomicForce>& out) const override;
  [[nodiscard]] const AtomicForceChanges* atomic_changes() const override {
    return listed_anew_ ? nullptr : &changes_;
  }
  [[nodiscard]] std::span<const VertexRecord> atomic_slots() const override {
    return atomic_ ? atomic_->slots() : std::span<const VertexRecord>{};
  }
  [[nodiscard]] std::span<const VertexRecord> internal_sums() const override { return internal_; }
  [[nodiscard]] const std::optional<support::Diagnostic>& error() const override { return error_; }
  [[nodiscard]] std::string explain() const override;

 private:
  /// What is left to do for one interaction while its matches are repaired.
  struct Repair {
    InteractionTables* of = nullptr;
    MatchSet::Stale stale;
    std::vector<std::vector<DartId>> moved;    ///< by shape: keys of merged matches with other ends
    std::vector<std::vector<DartId>> regroup;  ///< by shape: keys of matches to be merged again
    void begin(InteractionTables& interaction);
  };

  [[nodiscard]] bool reads(InputOrigin::Kind kind) const;
  [[nodiscard]] ForceMoment moment(const Motion& motion, double time, double dt) const;
  bool rebuild();
  void lay_out();
  template <typename Change>
  void each_pass(const Change& change) {
    change(main_);
    if (atomic_) change(*atomic_);
  }

  // Repairs where links have changed (kernel_forces_repair.cpp). While `stale_` the tables are right,
  // but the passes have to be laid out again.

  /// False when an interaction cannot be repaired.
  bool repair(std::span<const compile::Dependence> changed);
  void repair(InteractionTables& of, std::span<const compile::Dependence> changed);
  void look_at(Repair& repair, const StaleMatch& stale);
  /// A match that keeps its shape, as `reading_` says. False: its row cannot stay.
  bool follow(Repair& repair, DartId key);
  void find_again(Repair& repair);
  void take_out(Repair& repair, DartId key);
  void put_in(Repair& repair, DartId key);
  void dissolve(Repair& repair, std::uint32_t shape, std::uint32_t group);
  void dissolve_between(Repair& repair, std::uint32_t shape, std::array<Row, 2> ends);
  void move_groups(Repair& repair);
  bool move_group(const InteractionTables& of, MergedTable& merged, std::uint32_t shape,
                  std::uint32_t group);
  void merge_again(Repair& repair);
  // What becomes of the list of atomic forces (kernel_forces_atomic.cpp).
  void note_gone(const InteractionTables& of, InteractionTables::Place place);
  void note_placed(const InteractionTables& of, DartId key);
  void list_placed();
  void list_match(const InteractionTables& of, InteractionTables::Place place,
                  std::vector<AtomicForce>& out) const;
  /// Where a force of a match is kept, and how much of what stands there it is.
  [[nodiscard]] std::pair<SignedSlot, double> kept_force(const InteractionTables& of,
                                                         InteractionTables::Place place,
                                                         std::uint32_t force) const;
  /// Is one thread to do all of it?
  [[nodiscard]] bool alone() const { return workers_.threads.count() == 1 || probe_.alone(); }
  bool run(ForcePass& pass, PassKernels kernels, const ForceMoment& moment,
           const ForceSums::Totals& out);
  /// The totals that the end of a step leaves.
  ForceSums::Totals end_totals(std::span<VertexRecord> force);
  /// Numbers that a kernel with one root leaves for each match of a shape, `values` long enough.
  bool run_numbers(InteractionTables& of, std::size_t shape, const ForceKernel& kernel,
                   const ForceMoment& moment, std::vector<double>& values);
  bool fail(const ForcePass::Failure& failure, PassKernels kernels, const ForceMoment& moment);
  bool fail(InteractionTables& of, std::uint32_t shape, std::uint32_t row,
            const ForceProgram& program, const ForceMoment& moment);
  /// Adds the matrices of all matches of a shape.
  bool add_bounds(InteractionTables& of, std::size_t shape, const ForceMoment& moment,
                  bool of_velocity, ElementBounds& bounds);

  ForceContext context_;
  std::vector<std::unique_ptr<InteractionTables>> interactions_;
  ForcePass main_;
  std::unique_ptr<ForcePass> atomic_;     // null when nobody asks for single forces
  const bool keep_internal_;
  std::vector<VertexRecord> internal_;    // sums on vertices, when kept
  AtomicForceChanges changes_;            // of the last refresh, unless all are listed anew
  bool listed_anew_ = true;
  std::vector<std::pair<std::uint32_t, DartId>> placed_;  // interaction and key of matches put in
  // Work space of repairs.
  Repair repair_;
  MatchSet::Reading reading_;
  std::vector<DartId> members_;
  std::vector<std::uint32_t> between_;
  std::uint64_t found_again_ = 0;
  bool stale_ = false;
  ThreadProbe probe_;
  ForceWorkers workers_;
  std::set<std::pair<std::uint32_t, DartId>> warned_;
  std::optional<support::Diagnostic> error_;
};

}  // namespace gmsim::engine
