// SPDX-License-Identifier: MIT
#include <utility>

#include "engine/simulation_implementation.h"

namespace gmsim::engine {

bool Simulation::Implementation::change_map(StepReport& report,
                                            support::Diagnostics& diagnostics) {
  std::optional<support::Diagnostic> problem;
  if (changes_->has_rewrites()) {
    sync();
    Effects effects;
    problem = changes_->rewrite(effects);
    // A rule that changes values only may have changed parameters or velocities.
    if (effects.applications > 0) {
      report.map_changed = !effects.touched.empty();
      if (!adopt_map(effects.touched, diagnostics)) return false;
    }
  }
  if (!problem && changes_->has_criteria()) {
    TearOutcome outcome;
    problem = changes_->tear(now_.motion, now_.time, report.dt, [this] { sync(); }, outcome);
    report.events = std::move(outcome.events);
    report.dropped = outcome.dropped;
    if (!outcome.effects.touched.empty()) {
      report.map_changed = true;
      if (!adopt_map(outcome.effects.touched, diagnostics)) return false;
    }
  }
  if (!problem) return true;
  diagnostics.report(std::move(*problem));
  return false;
}

bool Simulation::Implementation::adopt_map(std::span<const DartId> touched,
                                           support::Diagnostics& diagnostics) {
  forces_->refresh(touched);
  if (!hold_vertices(diagnostics) || !weigh_vertices(diagnostics)) return false;
  load_motion();
  edges_.follow(state_);
  prescribed_.begin_step(now_);
  if (!first_forces(diagnostics)) return false;
  if (auto problem = changes_->rebuild()) {
    diagnostics.report(std::move(*problem));
    return false;
  }
  return true;
}

std::optional<std::vector<Simulation::CriterionReport>> Simulation::Implementation::survey(
    support::Diagnostics& diagnostics) {
  std::vector<CriterionReport> reports;
  if (!changes_) return reports;
  sync();
  if (!first_forces(diagnostics)) return std::nullopt;
  std::vector<TearRequest> requests;
  for (const auto& field : changes_->criteria().fields()) field->keep_ratios(true);
  auto problem = changes_->criteria().judge(now_.motion, now_.time, dt(), requests);
  for (const auto& field : changes_->criteria().fields()) {
    reports.push_back({field->nearest(), field->survey().ratios});
    field->keep_ratios(false);
  }
  if (!problem) return reports;
  diagnostics.report(std::move(*problem));
  return std::nullopt;
}

}  // namespace gmsim::engine
