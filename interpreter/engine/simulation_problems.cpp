// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>

#include "engine/integrators/vertex_masses.h"
#include "engine/simulation_implementation.h"

namespace gmsim::engine {

support::Diagnostic Simulation::Implementation::above_limit(double dt) const {
  const bool surely = dt > limit_.dt_global;
  support::Diagnostic problem{
      support::DiagnosticKind::Unstable,
      surely ? fmt::format("time step {:.6g} s is {:.4g} times the stability limit {:.6g} s of `{}`",
                           dt, dt / limit_.dt_global, limit_.dt_global, info_->name)
             : fmt::format("time step {:.6g} s is {:.4g} times the element-wise stability bound "
                           "{:.6g} s of `{}`, which holds after any tear",
                           dt, dt / limit_.dt, limit_.dt, info_->name),
      settings_.span};
  add_limit_notes(dt, problem);
  problem.help = surely ? fmt::format("take `dt` below {:.4g}, or `on_unstable: substep`",
                                      limit_.dt_global)
                        : fmt::format("`dt` below {:.4g} is stable whatever tears", limit_.dt);
  return problem;
}

void Simulation::Implementation::add_limit_notes(double dt, support::Diagnostic& problem) const {
  problem.notes.push_back(
      fmt::format("highest frequency {:.6g} rad/s with damping ratio {:.3g}; limit {:.6g} s, "
                  "dt/limit {:.4g}; element-wise bound {:.6g} rad/s, limit {:.6g} s",
                  limit_.omega_global, limit_.damping_ratio, limit_.dt_global,
                  dt / limit_.dt_global, limit_.omega_bound, limit_.dt));
  const std::string place = place_of_limit();
  if (!place.empty()) problem.notes.push_back("stiffest for its mass: " + place);
}

std::string Simulation::Implementation::place_of_limit() const {
  if (limit_.where == gmap::kNoDart) return {};
  const std::string place = row_text(vertices().row(limit_.where));
  return fmt::format("`{}` at {}", state_.program.interactions[limit_.interaction].name, place);
}

std::string Simulation::Implementation::row_text(Row row) const {
  if (!vertices().alive(row)) return fmt::format("row {}", row);
  const DartId dart = vertices().smallest(row);
  if (row >= now_.rows()) return vertex_text(state_, dart);
  const VertexRecord& x = now_.motion.position[row];
  return fmt::format("vertex ({:.6g}, {:.6g}, {:.6g}), dart {}", x.x, x.y, x.z,
                     types::index(dart));
}

support::Diagnostic Simulation::Implementation::diverged(double dt, const std::string& what,
                                                         Row row) const {
  support::Diagnostic problem{support::DiagnosticKind::Diverged, "the run diverged: " + what,
                              settings_.span};
  problem.notes.push_back(
      fmt::format("step {}, t = {:.9g} s, dt = {:.6g} s: {}; the state is that of t = {:.9g} s",
                  steps_ + 1, now_.time + dt, dt, row_text(row), now_.time));
  if (std::isfinite(limit_.dt_global)) add_limit_notes(dt, problem);
  problem.help = dt > limit_.dt_global
                     ? fmt::format("take `dt` below {:.4g}", limit_.dt_global)
                     : std::string("the step is below the stability limit: look for forces that "
                                   "grow without bound, or try half the `dt`");
  return problem;
}

support::Diagnostic Simulation::Implementation::failed_forces(double dt) const {
  if (!equations_.error())
    return diverged(dt, "the forces cannot be evaluated", 0);
  support::Diagnostic problem = *equations_.error();
  problem.notes.push_back(fmt::format("step {}, t = {:.9g} s, dt = {:.6g} s; the state is that of "
                                      "t = {:.9g} s",
                                      steps_ + 1, now_.time + dt, dt, now_.time));
  if (dt > limit_.dt_global && limit_.dt_global > 0) add_limit_notes(dt, problem);
  return problem;
}

}  // namespace gmsim::engine
