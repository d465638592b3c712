// SPDX-License-Identifier: MIT
#include <chrono>
#include <numeric>
#include <utility>

#include "engine/simulation_implementation.h"

namespace gmsim::engine {
namespace {

/// Adds the time that passes between two calls.
class Laps {
 public:
  void add_to(double& seconds) {
    const auto now = Clock::now();
    seconds += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

}  // namespace

bool Simulation::Implementation::change_map(StepReport& report,
                                            support::Diagnostics& diagnostics) {
  std::optional<support::Diagnostic> problem;
  if (changes_->has_rewrites()) {
    Laps laps;
    sync();
    Effects effects;
    problem = changes_->rewrite(effects);
    laps.add_to(report.cost.rewrite);
    // What rules wrote (parameters, masses) is not among the touched darts: everything is looked at.
    if (!effects.nothing()) {
      report.map_changed = !effects.touched.empty();
      if (!adopt_map(diagnostics)) return false;
    }
  }
  bool again = changes_->has_criteria();
  for (std::uint32_t pass = 0; again && !problem; ++pass) {
    problem = changes_->judge(now_.motion, now_.time, report.dt, [this] { lend_motion(); }, pass);
    TearOutcome outcome;
    Laps laps;
    if (!problem) problem = changes_->tear(outcome);
    laps.add_to(report.cost.rewrite);
    report.events.insert(report.events.end(), outcome.events.begin(), outcome.events.end());
    report.dropped += outcome.dropped;
    if (outcome.effects.nothing()) break;
    report.map_changed = report.map_changed || !outcome.effects.touched.empty();
    if (!adopt_changes(outcome.effects, report.cost, diagnostics)) {
      take_motion_back();
      return false;
    }
    again = !outcome.effects.touched.empty() && changes_->judges_again();
  }
  take_motion_back();
  if (!problem) return true;
  diagnostics.report(std::move(*problem));
  return false;
}

void Simulation::Implementation::lend_motion() {
  const auto lend = [&](EmbeddingId id, const std::vector<VertexRecord>& records) {
    constexpr std::uint32_t kRecord = sizeof(VertexRecord) / sizeof(double);
    if (records.empty()) return;
    state_.store.column(id).read_from(&records.front().x, kRecord,
                                      static_cast<Row>(records.size()));
  };
  lend(position_, now_.motion.position);
  lend(velocity_, now_.motion.velocity);
  set_clock();
}

void Simulation::Implementation::take_motion_back() {
  state_.store.column(position_).stop_reading();
  state_.store.column(velocity_).stop_reading();
}

bool Simulation::Implementation::adopt_map(support::Diagnostics& diagnostics) {
  forces_->refresh({});
  std::vector<Row> rows(vertices().row_end());
  std::iota(rows.begin(), rows.end(), Row{0});
  prescribed_.follow(state_, rows);
  if (!hold_vertices(diagnostics) || !weigh_vertices(diagnostics)) return false;
  load_motion();
  return prescribe_now(diagnostics) && first_forces(diagnostics) && find_criteria(diagnostics);
}

bool Simulation::Implementation::adopt_changes(const Effects& effects, ChangeCost& cost,
                                               support::Diagnostics& diagnostics) {
  Laps laps;
  const MapDelta delta = map_delta(state_, effects);
  cost.touched_darts += effects.touched.size();
  const std::uint64_t before = forces_->found_again();
  forces_->refresh(delta.darts);
  cost.matches += forces_->found_again() - before;
  laps.add_to(cost.tables);
  if (!adopt_vertices(delta, diagnostics)) return false;
  laps.add_to(cost.vertices);
  if (!forces_->evaluate_changes(now_.motion, now_.time, dt_ / substeps_, now_.force)) {
    diagnostics.report(failed_forces(dt_));
    return false;
  }
  laps.add_to(cost.forces);
  auto problem = changes_->repair(effects, delta, cost.criterion_matches);
  laps.add_to(cost.criteria);
  if (!problem) return true;
  diagnostics.report(std::move(*problem));
  return false;
}

bool Simulation::Implementation::adopt_vertices(const MapDelta& delta,
                                                support::Diagnostics& diagnostics) {
  const Row rows = vertices().row_end();
  fixed_.resize(rows);
  held_.resize(rows);
  const bool moved = prescribed_.follow(state_, delta.vertices);
  for (const Row row : delta.vertices)
    if (!hold_vertex(row, diagnostics)) return false;
  if (!masses_.local()) {
    if (!weigh_vertices(diagnostics)) return false;
  } else {
    std::optional<support::Diagnostic> problem;
    if (!masses_.weigh(delta.vertices, held_, problem)) {
      diagnostics.report(std::move(*problem));
      return false;
    }
    for (const Row row : delta.vertices) equations_.set_inverse_mass(row, masses_.inverse()[row]);
  }
  // The store has its own copy of these before what it reads from moves.
  for (const EmbeddingId id : {position_, velocity_})
    for (const Row row : delta.vertices) (void)state_.store.column(id).get(row);
  take_motion_back();
  now_.resize(rows);
  next_.resize(rows);
  method_->resize(rows);
  for (const Row row : delta.vertices) load_vertex(row);
  torn_.insert(torn_.end(), delta.vertices.begin(), delta.vertices.end());
  next_.time = now_.time;  // there is nothing to interpolate across a change of the map
  return !moved || prescribe_now(diagnostics);
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
  for (const auto& field : changes_->criteria().fields()) {
    field->follow_nearest(true);
    field->keep_ratios(true);
  }
  auto problem = changes_->criteria().judge(now_.motion, now_.time, dt(), [] {}, requests);
  for (const auto& field : changes_->criteria().fields()) {
    reports.push_back({field->nearest(), field->ratios()});
    field->follow_nearest(options_.follow_nearest);
    field->keep_ratios(false);
  }
  if (!problem) return reports;
  diagnostics.report(std::move(*problem));
  return std::nullopt;
}

}  // namespace gmsim::engine
