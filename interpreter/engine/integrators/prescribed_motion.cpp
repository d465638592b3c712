// SPDX-License-Identifier: MIT
#include "engine/integrators/prescribed_motion.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <unordered_map>

#include "gmap/orbit_walk.h"

namespace gmsim::engine {
namespace {

/// Abscissae in [-1, 1] and weights of Gauss-Legendre quadrature with five points.
constexpr double kAbscissa[] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831,
                                0.9061798459386640};
constexpr double kWeight[] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                              0.4786286704993665, 0.2369268850561891};

/// A difference quotient over this part of a step is exact to rounding for motions that the
/// integrator resolves, and stays on one side of most kinks.
constexpr double kDifference = 1. / 8;

/// The darts of the vertices of `vertices`.
std::vector<DartId> all_darts(const State& state, std::span<const DartId> vertices) {
  std::vector<DartId> darts;
  for (const DartId vertex : vertices)
    gmap::for_each_dart(state.map, OrbitType::cell(0, state.map.dimension()), vertex,
                        [&](DartId d) { darts.push_back(d); });
  return darts;
}

}  // namespace

PrescribedMotions::PrescribedMotions(State& state, const std::vector<PrescribedMotion>& motions) {
  const gmap::OrbitIndex& vertices =
      state.store.use_index(state.program.schema[*state.program.schema.find("position")].orbit);
  std::unordered_map<gmap::Row, const PrescribedMotion*> taken;
  for (const PrescribedMotion& motion : motions) {
    std::vector<gmap::Row> rows;
    std::vector<DartId> darts;
    for (const DartId dart : motion.vertices) {
      const gmap::Row row = vertices.row(dart);
      const auto [mover, first_time] = taken.emplace(row, &motion);
      if (!first_time && mover->second == &motion) continue;
      if (!first_time) {
        error_ = support::Diagnostic{support::DiagnosticKind::Conflict,
                                     "a vertex is moved by two prescribed motions", motion.span};
        return;
      }
      rows.push_back(row);
      darts.push_back(dart);
    }
    if (rows.empty()) continue;
    const std::size_t first = drivers_.size();
    if (same_everywhere(motion.expression)) {
      drivers_.push_back({all_darts(state, darts), rows, motion.gives_position,
                          ClockExpression(state, motion.expression, darts.front())});
    } else {
      for (std::size_t i = 0; i < rows.size(); ++i)
        drivers_.push_back({all_darts(state, {&darts[i], 1}), {rows[i]}, motion.gives_position,
                            ClockExpression(state, motion.expression, darts[i])});
    }
    for (std::size_t i = first; i < drivers_.size(); ++i)
      if (drivers_[i].function.error()) {
        error_ = drivers_[i].function.error();
        return;
      }
  }
}

std::vector<gmap::Row> PrescribedMotions::rows() const {
  std::vector<gmap::Row> all;
  for (const Driver& driver : drivers_) all.insert(all.end(), driver.rows.begin(), driver.rows.end());
  std::ranges::sort(all);
  return all;
}

void PrescribedMotions::follow(const State& state) {
  const gmap::OrbitIndex* vertices =
      state.store.find_index(OrbitType::cell(0, state.map.dimension()));
  for (Driver& driver : drivers_) {
    std::erase_if(driver.darts, [&](DartId d) { return !state.map.alive(d); });
    driver.rows.clear();
    for (const DartId d : driver.darts) driver.rows.push_back(vertices->row(d));
    std::ranges::sort(driver.rows);
    driver.rows.erase(std::ranges::unique(driver.rows).begin(), driver.rows.end());
  }
}

void PrescribedMotions::begin_step(const PhasePoint& now) {
  for (Driver& driver : drivers_) {
    if (driver.gives_position) continue;
    driver.from.resize(driver.rows.size());
    for (std::size_t i = 0; i < driver.rows.size(); ++i)
      driver.from[i] = now.motion.position[driver.rows[i]];
    driver.from_time = now.time;
    driver.time = std::numeric_limits<double>::quiet_NaN();
  }
}

bool PrescribedMotions::apply(double time, Motion& motion) {
  for (Driver& driver : drivers_) {
    if (driver.time != time && !evaluate(driver, time)) {
      error_ = driver.function.error();
      return false;
    }
    const VertexRecord moved{driver.moved[0], driver.moved[1], driver.moved[2]};
    const VertexRecord velocity{driver.velocity[0], driver.velocity[1], driver.velocity[2]};
    for (std::size_t i = 0; i < driver.rows.size(); ++i) {
      VertexRecord& x = motion.position[driver.rows[i]];
      x = moved;
      if (!driver.gives_position) {
        x.x += driver.from[i].x;
        x.y += driver.from[i].y;
        x.z += driver.from[i].z;
      }
      motion.velocity[driver.rows[i]] = velocity;
    }
  }
  return true;
}

bool PrescribedMotions::evaluate(Driver& driver, double time) {
  const auto value = driver.function.at(time);
  if (!value) return false;
  if (driver.gives_position) {
    const double distance =
        std::max(kDifference * step_, 1e-9 * std::max(1.0, std::abs(time)));
    const auto rate = driver.function.rate(time, distance);
    if (!rate) return false;
    driver.moved = *value;
    driver.velocity = *rate;
  } else {
    driver.velocity = *value;
    if (!integrate(driver, time)) return false;
  }
  driver.time = time;
  return true;
}

bool PrescribedMotions::integrate(Driver& driver, double time) {
  const double half = 0.5 * (time - driver.from_time);
  driver.moved = {};
  if (half == 0) return true;
  for (std::size_t k = 0; k < std::size(kAbscissa); ++k) {
    const auto velocity = driver.function.at(driver.from_time + half * (1 + kAbscissa[k]));
    if (!velocity) return false;
    for (std::size_t i = 0; i < 3; ++i) driver.moved[i] += half * kWeight[k] * (*velocity)[i];
  }
  return true;
}

}  // namespace gmsim::engine
