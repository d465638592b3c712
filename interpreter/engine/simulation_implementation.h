// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/guard.h"
#include "engine/integrators/equations_of_motion.h"
#include "engine/integrators/integrator.h"
#include "engine/integrators/phase_point.h"
#include "engine/integrators/prescribed_motion.h"
#include "engine/integrators/step_control.h"
#include "engine/integrators/vertex_masses.h"
#include "engine/map_changes.h"
#include "engine/simulation.h"
#include "engine/stability.h"

namespace gmsim::engine {

class Simulation::Implementation {
 public:
  Implementation(State& state, Model model, IntegratorSettings settings,
                 std::unique_ptr<ForceField> forces, SimulationOptions options);

  // simulation_setup.cpp
  bool prepare(support::Diagnostics& diagnostics);
  bool refresh(support::Diagnostics& diagnostics);

  // simulation_step.cpp
  std::optional<StepReport> step(double until, support::Diagnostics& diagnostics);

  // simulation_map.cpp
  std::optional<std::vector<CriterionReport>> survey(support::Diagnostics& diagnostics);

  // simulation_report.cpp
  void dense_positions(double time, std::vector<double>& out) const;
  [[nodiscard]] Totals totals();
  void sync();
  [[nodiscard]] std::uint64_t state_hash() const;
  [[nodiscard]] std::string explain() const;
  [[nodiscard]] double max_elongation() const {
    return edges_.max_elongation(state_, now_.motion);
  }

  [[nodiscard]] double time() const { return now_.time; }
  [[nodiscard]] std::uint64_t steps() const { return steps_; }
  [[nodiscard]] std::uint64_t evaluations() const { return equations_.evaluations(); }
  [[nodiscard]] double dt() const {
    return info_->adaptive ? std::min(control_.next(), adaptive_cap()) : dt_;
  }
  [[nodiscard]] const StabilityLimit& limit() const { return limit_; }

 private:
  // simulation_setup.cpp
  bool hold_vertices(support::Diagnostics& diagnostics);
  bool weigh_vertices(support::Diagnostics& diagnostics);
  void load_motion();
  void load_vertex(Row row);
  /// Puts prescribed vertices where they are at this time.
  bool prescribe_now(support::Diagnostics& diagnostics);
  bool first_forces(support::Diagnostics& diagnostics);

  // simulation_step_choice.cpp
  bool find_limit(support::Diagnostics& diagnostics);
  bool choose_step(support::Diagnostics& diagnostics);
  bool judge_step(support::Diagnostics& diagnostics);
  [[nodiscard]] std::uint32_t substeps_for(double dt) const;
  [[nodiscard]] double adaptive_cap() const;
  void choose_tolerance();
  bool choose_first_step(support::Diagnostics& diagnostics);

  // simulation_step.cpp
  bool advance_fixed(double until, support::Diagnostics& diagnostics);
  bool advance_adaptive(double until, StepReport& report, support::Diagnostics& diagnostics);
  bool try_step(double dt);
  [[nodiscard]] bool stiffened_by_tears(double dt);
  bool review(double dt, support::Diagnostics& diagnostics);
  /// Null when the step may count.
  [[nodiscard]] std::optional<support::Diagnostic> objection(double dt);

  // simulation_map.cpp
  /// The end of a step: what rules do to the map, and what follows for forces and masses.
  bool change_map(StepReport& report, support::Diagnostics& diagnostics);
  /// After changes anywhere.
  bool adopt_map(support::Diagnostics& diagnostics);
  /// The same at the cost of what changed alone.
  bool adopt_changes(const Effects& effects, ChangeCost& cost, support::Diagnostics& diagnostics);
  bool adopt_vertices(const MapDelta& delta, support::Diagnostics& diagnostics);
  bool hold_vertex(Row row, support::Diagnostics& diagnostics);
  bool find_criteria(support::Diagnostics& diagnostics);
  /// The store reads the motion of vertices from now_, until it is taken back. Cheaper than sync()
  /// where few vertices are looked at.
  void lend_motion();
  void take_motion_back();

  // simulation_report.cpp
  void set_clock();

  // simulation_problems.cpp
  [[nodiscard]] support::Diagnostic above_limit(double dt) const;
  [[nodiscard]] support::Diagnostic diverged(double dt, const std::string& what, Row row) const;
  void add_limit_notes(double dt, support::Diagnostic& problem) const;
  [[nodiscard]] support::Diagnostic failed_forces(double dt) const;
  [[nodiscard]] std::string place_of_limit() const;
  [[nodiscard]] std::string row_text(Row row) const;

  [[nodiscard]] const gmap::OrbitIndex& vertices() const {
    return state_.store.index_of(position_);
  }
  /// J, of the vertices that forces move.
  [[nodiscard]] double free_kinetic_energy(const PhasePoint& point) const;

  State& state_;
  Model model_;
  IntegratorSettings settings_;
  SimulationOptions options_;
  const IntegratorInfo* info_;
  EmbeddingId position_, velocity_;

  std::unique_ptr<ForceField> forces_;
  PrescribedMotions prescribed_;
  EquationsOfMotion equations_;
  std::unique_ptr<Integrator> method_;
  StabilityEstimator estimator_;
  StepControl control_;

  std::vector<bool> held_;       // by row: fixed or prescribed
  std::vector<bool> fixed_;
  VertexMasses masses_;
  EdgeLengths edges_;
  Guard guard_;
  StabilityLimit limit_;

  std::unique_ptr<MapChanges> changes_;  // null when nothing changes the map

  PhasePoint now_, next_;        // next_ is the point before now_ between steps
  PhasePoint before_;            // where a step of several substeps began
  Tolerance tolerance_;          // of methods that choose their step
  double dt_ = 0;                // s, of methods with a fixed step
  std::uint32_t substeps_ = 1;
  std::uint64_t steps_ = 0;
  std::uint64_t next_review_ = 0;   // step
  std::uint64_t next_look_ = 0;     // step before which suspicions are not followed
  bool limit_fell_ = false;         // below the step, and that was said
  std::vector<Row> torn_;           // vertices that changed since the limit was looked at
};

}  // namespace gmsim::engine
