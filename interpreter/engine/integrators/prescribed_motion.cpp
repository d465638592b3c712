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

}  // namespace

PrescribedMotions::PrescribedMotions(State& state, const std::vector<PrescribedMotion>& motions) {
  const gmap::OrbitIndex& vertices =
      state.store.use_index(state.program.schema[*state.program.schema.find("position")].orbit);
  std::unordered_map<gmap::Row, const PrescribedMotion*> taken;
  for (const PrescribedMotion& motion : motions) {
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
      darts.push_back(dart);
    }
    if (darts.empty()) continue;
    const std::size_t first = drivers_.size();
    if (same_everywhere(motion.expression)) {
      add(state, darts, motion.gives_position,
          ClockExpression(state, motion.expression, darts.front()));
    } else {
      for (const DartId& dart : darts)
        add(state, {&dart, 1}, motion.gives_position,
            ClockExpression(state, motion.expression, dart));
    }
    for (std::size_t i = first; i < drivers_.size(); ++i)
      if (drivers_[i].function.error()) {
        error_ = drivers_[i].function.error();
        return;
      }
  }
}

void PrescribedMotions::add(const State& state, std::span<const DartId> vertices,
                            bool gives_position, ClockExpression function) {
  const OrbitType vertex = OrbitType::cell(0, state.map.dimension());
  const gmap::OrbitIndex& index = *state.store.find_index(vertex);
  drivers_.push_back({{}, gives_position, std::move(function)});
  driver_of_dart_.resize(state.map.dart_end());
  driver_of_row_.resize(index.row_end());
  const auto number = static_cast<std::uint32_t>(drivers_.size());
  for (const DartId dart : vertices) {
    drivers_.back().rows.push_back(index.row(dart));
    driver_of_row_[index.row(dart)] = number;
    gmap::for_each_dart(state.map, vertex, dart,
                        [&](DartId d) { driver_of_dart_[types::index(d)] = number; });
  }
  std::ranges::sort(drivers_.back().rows);
}

std::uint32_t PrescribedMotions::driver_at(const State& state, DartId dart) const {
  std::uint32_t driver = 0;
  gmap::for_each_dart(state.map, OrbitType::cell(0, state.map.dimension()), dart, [&](DartId d) {
    if (types::index(d) < driver_of_dart_.size())
      driver = std::max(driver, driver_of_dart_[types::index(d)]);
  });
  return driver;
}

bool PrescribedMotions::follow(const State& state, std::span<const gmap::Row> changed) {
  if (empty()) return false;
  const gmap::OrbitIndex& vertices =
      *state.store.find_index(OrbitType::cell(0, state.map.dimension()));
  driver_of_row_.resize(vertices.row_end());
  bool concerned = false;
  for (const gmap::Row row : changed) {
    const std::uint32_t before = driver_of_row_[row];
    const std::uint32_t now = vertices.alive(row) ? driver_at(state, vertices.smallest(row)) : 0;
    concerned = concerned || before != 0 || now != 0;
    if (before == now) continue;
    driver_of_row_[row] = now;
    if (before != 0) {
      std::vector<gmap::Row>& rows = drivers_[before - 1].rows;
      rows.erase(std::ranges::lower_bound(rows, row));
    }
    if (now != 0) {
      std::vector<gmap::Row>& rows = drivers_[now - 1].rows;
      rows.insert(std::ranges::lower_bound(rows, row), row);
    }
  }
  return concerned;
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
