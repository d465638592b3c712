// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/rewrite.h"
#include "engine/rewrite_rows.h"
#include "engine/spread_values.h"
#include "engine/value_machine.h"
#include "engine/value_programs.h"
#include "gmap/journal.h"

namespace gmsim::engine {

/// The work of Rewriter, with its work space.
class Rewriter::Implementation {
 public:
  Implementation(Rewriter& self, State& state, RewriteOptions options);

  /// Applies a rule and adds its effects to `outcome`, if it applies.
  void apply(const compile::Rule& rule, std::span<const DartId> hooks, const Arguments& arguments,
             RewriteOutcome& outcome);
  /// Matches and evaluates a rule that changes values only; its values wait for write_at_once().
  bool read_at_once(const compile::Rule& rule, DartId hook, const Arguments& arguments,
                    RewriteOutcome& outcome);
  void write_at_once(const compile::Rule& rule, RewriteOutcome& outcome);

  void begin();
  void commit();
  void roll_back();
  [[nodiscard]] gmap::Journal* journal() { return recording_ ? &journal_ : nullptr; }

  State& state;
  Matcher matcher;
  CreatedOrbitHook on_created;

 private:
  using Diagnostic = std::optional<support::Diagnostic>;
  /// Of the effects before the rewrite at hand, beside those of the orbits.
  struct Counts {
    std::size_t touched = 0, written = 0;
    std::uint64_t created_darts = 0, removed_darts = 0, written_values = 0;
  };

  bool match(const compile::Rule& rule, std::span<const DartId> hooks, const Arguments& arguments,
             RewriteOutcome& outcome);
  [[nodiscard]] bool may_fail(const compile::Rule& rule);
  [[nodiscard]] Counts count_effects() const;
  void forget_effects(const Counts& before);
  // values of the right side, on the old map
  bool evaluate(const compile::Rule& rule, RewriteOutcome& outcome);
  bool run_program(const compile::Rule& rule);
  bool evaluate_trees(const compile::Rule& rule, RewriteOutcome& outcome);
  bool evaluate_at(const compile::Rule& rule, const compile::Assignment& assignment,
                   std::uint32_t row, RewriteOutcome& outcome);
  bool bind_row(const compile::MatchPlan& plan, std::uint32_t row, RewriteOutcome& outcome);
  // topology
  void change_links(const compile::RewritePlan& plan);
  void add_darts(const compile::RewritePlan& plan);
  void write_links();
  void remove_darts();
  void append(const std::vector<RowPlan::Place>& places, std::vector<DartId>& out) const;
  std::span<const DartId> gather(const std::vector<RowPlan::Place>& places,
                                 std::vector<DartId>& memory) const;
  // rewrite_orbits.cpp
  void repair_orbits(const compile::RewritePlan& plan);
  void list_touched(const compile::RewritePlan& plan, OrbitType type);
  void follow_classes(const RowPlan::Orbits& orbits, gmap::OrbitIndex& index,
                      gmap::OrbitRepair& repair);
  void enter_kept(const RowPlan::Orbits& orbits, gmap::OrbitIndex& index);
  void publish_kept(const gmap::OrbitIndex& index, std::size_t first, gmap::OrbitRepair& repair);
  // values on the new map
  Diagnostic store_values(const compile::Rule& rule);
  Diagnostic announce_created();
  [[nodiscard]] static Diagnostic report_broken(const std::vector<std::string>& broken);
  void fail(const compile::Rule& rule, support::Diagnostic diagnostic, RewriteOutcome& outcome);
  void fail_evaluation(const compile::Rule& rule, RewriteOutcome& outcome);

  Rewriter& self_;
  RewriteOptions options_;
  gmap::Journal journal_;
  bool recording_ = false;
  ValueSpreader spreader_;
  RowPlans row_plans_;
  ValuePrograms programs_;
  ValueMachine machine_;

  // work space of one application
  Frame frame_;
  Match match_;
  std::vector<DartId> hooks_;
  RowPlan* row_plan_ = nullptr;         // of the match
  std::vector<AssignedValue> assigned_;
  std::vector<std::pair<std::uint32_t, compile::Column>> assigned_cells_;  // row and column
  std::vector<double> numbers_;
  std::vector<DartId> touched_;
  std::vector<ChangedOrbits> changed_;
  gmap::RepairSpace repair_space_;            // of all repairs
  std::vector<Row> kept_rows_;                // of orbits that created darts entered
  std::vector<DartId> whole_;                 // darts of whole orbits, one orbit after the other
  Effects* effects_ = nullptr;                // of the caller, who may have had others
};

}  // namespace gmsim::engine
