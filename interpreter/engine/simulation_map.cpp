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
    // What rules wrote (parameters, masses) is not among the touched darts: everything is looked at.
    if (effects.applications > 0) {
      report.map_changed = !effects.touched.empty();
      if (!adopt_map({}, diagnostics)) return false;
    }
  }
  bool again = changes_->has_criteria();
  for (std::uint32_t pass = 0; again && !problem; ++pass) {
    TearOutcome outcome;
    problem = changes_->tear(now_.motion, now_.time, report.dt, [this] { sync(); }, pass, outcome);
    report.events.insert(report.events.end(), outcome.events.begin(), outcome.events.end());
    report.dropped += outcome.dropped;
    again = !outcome.effects.touched.empty();
    if (!again) break;
    report.map_changed = true;
    if (!adopt_map(outcome.effects.touched, diagnostics)) return false;
    again = changes_->judges_again();
  }
  if (!problem) return true;
  diagnostics.report(std::move(*problem));
  return false;
}

bool Simulation::Implementation::adopt_map(std::span<const DartId> touched,
                                           support::Diagnostics& diagnostics) {
  forces_->refresh(touched);
  prescribed_.follow(state_);
  if (!hold_vertices(diagnostics) || !weigh_vertices(diagnostics)) return false;
  load_motion();
  edges_.follow(state_);
  return prescribe_now(diagnostics) && first_forces(diagnostics) && find_criteria(diagnostics);
}

bool Simulation::Implementation::find_criteria(support::Diagnostics& diagnostics) {
  if (!changes_) return true;
  auto problem = changes_->rebuild();
  if (!problem) return true;
  diagnostics.report(std::move(*problem));
  return false;
}

std::optional<std::vector<Simulation::CriterionReport>> Simulation::Implementation::survey(
    support::Diagnostics& diagnostics) {
  std::vector<CriterionReport> reports;
  if (!changes_) return reports;
  sync();
  if (!first_forces(diagnostics)) return std::nullopt;
  std::vector<TearRequest> requests;
  for (const auto& field : changes_->criteria().fields()) field->keep_ratios(true);
  auto problem = changes_->criteria().judge(now_.motion, now_.time, dt(), [] {}, requests);
  for (const auto& field : changes_->criteria().fields()) {
    reports.push_back({field->nearest(), field->ratios()});
    field->keep_ratios(false);
  }
  if (!problem) return reports;
  diagnostics.report(std::move(*problem));
  return std::nullopt;
}

}  // namespace gmsim::engine
