// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/integrators/vertex_record_math.h"
#include "engine/simulation_implementation.h"

namespace gmsim::engine {
namespace {

/// The model is looked at after 1, 2, 4 … steps, then after every so many.
constexpr std::uint64_t kReviewEvery = 256;
constexpr std::uint64_t kLookEvery = 16;

}  // namespace

std::optional<StepReport> Simulation::Implementation::step(double until,
                                                           support::Diagnostics& diagnostics) {
  const double begin = now_.time;
  const std::uint64_t before = equations_.evaluations();
  StepReport report;
  const bool done = info_->adaptive ? advance_adaptive(until, report, diagnostics)
                                    : advance_fixed(until, diagnostics);
  if (!done) return std::nullopt;
  ++steps_;
  forces_->set_step(steps_);
  report.time = now_.time;
  report.dt = now_.time - begin;
  report.evaluations = static_cast<std::uint32_t>(equations_.evaluations() - before);
  if (options_.trace != nullptr && options_.trace->wants(support::TracePhase::Step, ""))
    options_.trace->line(support::TracePhase::Step, "",
                         fmt::format("{:>7}  t={:.9g}  dt={:.9g}", steps_, now_.time, report.dt));
  if (changes_ && !change_map(report, diagnostics)) return std::nullopt;
  if (!review(report.dt, diagnostics)) return std::nullopt;
  return report;
}

bool Simulation::Implementation::advance_fixed(double until, support::Diagnostics& diagnostics) {
  // Times are multiples of the step as long as none was shortened, so that they do not drift.
  const double count = static_cast<double>(steps_);
  const bool on_grid = std::abs(now_.time - count * dt_) <= 1e-6 * dt_;
  double end = on_grid ? (count + 1) * dt_ : now_.time + dt_;
  double length = dt_;
  const double slack = std::max(1e-9 * dt_, 4e-16 * std::abs(until));
  if (end > until + slack) length = until - now_.time;
  if (end > until - slack) end = until;

  const double part = length / substeps_;
  if (substeps_ > 1) before_ = now_;  // what a failure within the step goes back to
  for (std::uint32_t i = 0; i < substeps_; ++i) {
    if (!try_step(part)) {
      diagnostics.report(failed_forces(part));
    } else if (auto problem = objection(part)) {
      diagnostics.report(std::move(*problem));
    } else {
      std::swap(now_, next_);
      continue;
    }
    if (i > 0) now_ = before_;
    return false;
  }
  now_.time = end;
  return true;
}

bool Simulation::Implementation::advance_adaptive(double until, StepReport& report,
                                                  support::Diagnostics& diagnostics) {
  const double cap = adaptive_cap();
  const double least = std::max(settings_.dt_min, 1e-14 * std::max(std::abs(until), 1e-3));
  for (;;) {
    const double wish = std::min(control_.next(), cap);
    const double left = until - now_.time;
    const bool last = wish >= left * (1 - 1e-9);
    // The step before the last is halved rather than followed by a tiny one.
    const double dt = last ? left : std::min(wish, wish > 0.5 * left ? 0.5 * left : wish);
    const bool evaluated = try_step(dt);
    const bool finite = evaluated && Guard::look(next_).finite;
    const double error = finite ? method_->error_norm(equations_, now_, next_, dt, tolerance_)
                                : std::numeric_limits<double>::infinity();
    if (error <= 1) {
      if (auto problem = objection(dt)) {
        diagnostics.report(std::move(*problem));
        return false;
      }
      report.at_stability_limit = dt >= cap * (1 - 1e-12);
      control_.accept(dt, error, dt < wish);
      std::swap(now_, next_);
      if (last) now_.time = until;
      return true;
    }
    ++report.rejected;
    control_.reject(dt, error);
    if (control_.next() >= least) continue;
    if (!evaluated) {
      diagnostics.report(failed_forces(dt));
    } else {
      support::Diagnostic problem = diverged(
          dt, fmt::format("the step fell below {:.3g} s without meeting the tolerance", least),
          Guard::look(next_).row);
      problem.help = "a smaller `dt_min`, a larger `rtol`, or a look at what happens there";
      diagnostics.report(std::move(problem));
    }
    return false;
  }
}

bool Simulation::Implementation::try_step(double dt) {
  equations_.begin_step(now_);
  return method_->advance(equations_, now_, dt, next_);
}

std::optional<support::Diagnostic> Simulation::Implementation::objection(double dt) {
  const Guard::Finding finding = Guard::look(next_);
  if (!finding.finite)
    return diverged(dt, "a vertex has a position, velocity or force that is not finite",
                    finding.row);
  if (!guard_.suspicious(finding, dt) || steps_ < next_look_) return std::nullopt;
  next_look_ = steps_ + kLookEvery;
  if (guard_.outgrown(free_kinetic_energy(next_)))
    return diverged(dt, "the kinetic energy grew a thousandfold", finding.row);
  if (!estimator_.estimate(now_, equations_.inverse_mass(), limit_) || dt > limit_.dt_global)
    return diverged(dt,
                    "the step is above the stability limit and a vertex moves by more than the "
                    "shortest edge in it",
                    finding.row);
  return std::nullopt;
}

/// Elements that are torn apart keep the element-wise bound. Only a longer step has to fear that
/// vertices with less mass swing faster than any before.
bool Simulation::Implementation::stiffened_by_tears(double dt) {
  const std::vector<Row> torn = std::exchange(torn_, {});
  if (torn.empty() || dt / substeps_ <= limit_.dt) return false;
  return estimator_.has_stiffened_at(torn, now_, equations_.inverse_mass());
}

bool Simulation::Implementation::review(double dt, support::Diagnostics& diagnostics) {
  const bool stiffer = stiffened_by_tears(dt);
  if (steps_ < next_review_ && !stiffer) return true;
  next_review_ = steps_ + std::clamp<std::uint64_t>(steps_, 1, kReviewEvery);
  double potential = 0;
  if (forces_->potential_energy(now_.motion, now_.time, potential))
    guard_.note_energy(free_kinetic_energy(now_), potential);
  if (!stiffer && !estimator_.has_stiffened(now_, equations_.inverse_mass())) return true;
  if (!find_limit(diagnostics)) return false;
  if (info_->adaptive) return true;
  if (settings_.on_unstable == OnUnstable::Substep)
    substeps_ = std::max(substeps_, substeps_for(dt_));
  if (dt / substeps_ <= limit_.dt_global || limit_fell_) return true;
  limit_fell_ = true;
  support::Diagnostic problem = above_limit(dt / substeps_);
  problem.severity = support::Severity::Warning;
  diagnostics.report(std::move(problem));
  return true;
}

}  // namespace gmsim::engine
