// SPDX-License-Identifier: MIT
// A chain of particles with the standard library's embeddings, and forces written by hand, for tests
// of time stepping that need no rules.
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "check/check.h"
#include "compile/compile.h"
#include "engine/force_field.h"
#include "engine/simulation.h"
#include "engine/state.h"
#include "gmap/mesh_builders.h"

namespace gmsim::tests {

using engine::IntegratorSettings;
using engine::Motion;
using engine::VertexRecord;

/// Vertex k of the chain is row k; all particles have one mass.
class ParticleWorld {
 public:
  explicit ParticleWorld(std::uint32_t particles, double mass = 1, double length = 1)
      : rules_(check::check_texts({}, {}, sources, diagnostics)),
        program_(compile::compile_program(rules_.in(1))),
        built_(gmap::build_map(gmap::chain(particles - 1, length))),
        state(program_, built_.map) {
    state.use_data();
    for (std::uint32_t k = 0; k < particles; ++k) {
      place(k, {length * k / (particles - 1), 0, 0});
      weigh(k, mass);
    }
  }

  [[nodiscard]] types::DartId dart(std::uint32_t k) const { return built_.point_dart[k]; }
  [[nodiscard]] types::EmbeddingId id(const char* name) const {
    return program_.schema.find(name).value();
  }
  void place(std::uint32_t k, std::array<double, 3> x) { state.store.set(id("position"), dart(k), x); }
  void throw_at(std::uint32_t k, std::array<double, 3> v) {
    state.store.set(id("velocity"), dart(k), v);
  }
  void fix(std::uint32_t k) {
    const double yes = 1;
    state.store.set(id("fixed"), dart(k), {&yes, 1});
  }
  void weigh(std::uint32_t k, double mass) {
    const gmap::OrbitIndex& vertices = state.store.index_of(id("position"));
    std::vector<types::DartId> corners;
    for (std::uint32_t d = 0; d < state.map.dart_end(); ++d)
      if (vertices.row(types::DartId{d}) == vertices.row(dart(k))) corners.push_back(types::DartId{d});
    const double share = mass / static_cast<double>(corners.size());
    for (const types::DartId corner : corners)
      state.store.set(id("corner_mass"), corner, {&share, 1});
  }
  [[nodiscard]] std::array<double, 3> position(std::uint32_t k) const {
    return vec(state.store.get(id("position"), dart(k)));
  }
  [[nodiscard]] std::array<double, 3> velocity(std::uint32_t k) const {
    return vec(state.store.get(id("velocity"), dart(k)));
  }

  /// Vertices that move as `text` says: a vec3, with `time` and what is known at the vertex `a`.
  engine::PrescribedMotion moved(const std::vector<std::uint32_t>& particles, const std::string& text,
                                 bool gives_position) {
    const check::CheckedExpression checked = check::check_expression(
        rules_, 1, sources.add("motion", text), {types::ValueKind::Vec3}, sources, diagnostics);
    REQUIRE_MESSAGE(checked.value, messages());
    engine::PrescribedMotion motion;
    motion.gives_position = gives_position;
    motion.expression = {checked.value, checked.dart, checked.frame_size};
    for (const std::uint32_t k : particles) motion.vertices.push_back(dart(k));
    return motion;
  }

  /// Null after an error, which is in `diagnostics`.
  std::unique_ptr<engine::Simulation> simulate(std::unique_ptr<engine::ForceField> forces,
                                               IntegratorSettings settings,
                                               engine::Model model = {}) {
    return engine::Simulation::create(state, std::move(model), std::move(settings),
                                      std::move(forces), {}, diagnostics);
  }
  /// Steps to `end` and puts the result into the state; the number of steps.
  std::uint64_t run(engine::Simulation& simulation, double end) {
    while (simulation.time() < end)
      REQUIRE_MESSAGE(simulation.step(end, diagnostics).has_value(), messages());
    simulation.sync();
    return simulation.steps();
  }
  [[nodiscard]] std::string messages() const {
    std::string text;
    for (const support::Diagnostic& d : diagnostics.all()) {
      text += std::string(support::name_of(d.kind)) + ": " + d.message + "\n";
      for (const std::string& note : d.notes) text += "  note: " + note + "\n";
      if (!d.help.empty()) text += "  help: " + d.help + "\n";
    }
    return text;
  }

  support::SourceMap sources;
  support::Diagnostics diagnostics;

 private:
  static std::array<double, 3> vec(std::span<const double> x) { return {x[0], x[1], x[2]}; }

  check::CheckedRules rules_;
  compile::Program program_;
  gmap::MeshMap built_;

 public:
  engine::State state;
};

/// What most hand-written forces share.
class HandWrittenForces : public engine::ForceField {
 public:
  bool potential_energy(const Motion&, double, double& energy) override {
    energy = 0;
    return true;
  }
  /// By central differences; good to about 1e-8.
  bool product(const Motion& motion, double time, std::span<const VertexRecord> dx,
               std::span<const VertexRecord> dv, std::span<VertexRecord> out) override {
    constexpr double kStep = 1e-6;
    Motion moved = motion;
    std::vector<VertexRecord> low(out.size());
    for (const double sign : {-1.0, 1.0}) {
      for (std::size_t r = 0; r < out.size(); ++r) {
        shift(moved.position[r], motion.position[r], dx[r], sign * kStep);
        shift(moved.velocity[r], motion.velocity[r], dv[r], sign * kStep);
      }
      evaluate(moved, time, 0, sign < 0 ? std::span(low) : out);
    }
    for (std::size_t r = 0; r < out.size(); ++r) {
      out[r].x = (out[r].x - low[r].x) / (2 * kStep);
      out[r].y = (out[r].y - low[r].y) / (2 * kStep);
      out[r].z = (out[r].z - low[r].z) / (2 * kStep);
    }
    return true;
  }
  bool element_bound(const Motion&, double, ElementBound& out) override {
    out = bound;
    return true;
  }
  std::vector<support::Diagnostic> notices(const Motion&, double) override { return {}; }
  bool reads_velocity() const override { return true; }
  bool reads_time() const override { return false; }
  void refresh(std::span<const compile::Dependence>) override {}
  const std::optional<support::Diagnostic>& error() const override { return failure; }
  std::string explain() const override { return "hand-written forces\n"; }

  ElementBound bound;
  std::optional<support::Diagnostic> failure;

 private:
  static void shift(VertexRecord& to, const VertexRecord& from, const VertexRecord& by, double s) {
    to.x = from.x + s * by.x;
    to.y = from.y + s * by.y;
    to.z = from.z + s * by.z;
  }
};

/// Independent oscillators of mass 1 on every coordinate: f = -omega^2 x - 2 zeta omega v.
class Oscillators final : public HandWrittenForces {
 public:
  Oscillators(double omega, double zeta) : omega_(omega), zeta_(zeta) {
    bound.stiffness = omega * omega;
    bound.damping = 2 * zeta * omega;
  }
  bool evaluate(const Motion& motion, double, double, std::span<VertexRecord> force) override {
    for (std::size_t r = 0; r < force.size(); ++r)
      force[r] = {along(motion.position[r].x, motion.velocity[r].x),
                  along(motion.position[r].y, motion.velocity[r].y),
                  along(motion.position[r].z, motion.velocity[r].z)};
    return true;
  }
  bool potential_energy(const Motion& motion, double, double& energy) override {
    energy = 0;
    for (const VertexRecord& x : motion.position)
      energy += 0.5 * omega_ * omega_ * (x.x * x.x + x.y * x.y + x.z * x.z);
    return true;
  }
  bool reads_velocity() const override { return zeta_ != 0; }

 private:
  double along(double x, double v) const { return -omega_ * (omega_ * x + 2 * zeta_ * v); }
  double omega_, zeta_;
};

/// Springs between neighbours of the chain, with damping along them and gravity along -z.
class SpringChain final : public HandWrittenForces {
 public:
  SpringChain(double stiffness, double rest, double damping, double mass, double gravity = 0)
      : stiffness_(stiffness), rest_(rest), damping_(damping), weight_(mass * gravity) {
    bound.stiffness = 4 * stiffness / mass;
    bound.damping = 4 * damping / mass;
  }
  bool evaluate(const Motion& motion, double, double, std::span<VertexRecord> force) override {
    for (VertexRecord& f : force) f = {0, 0, -weight_};
    for (std::size_t r = 0; r + 1 < force.size(); ++r) {
      const VertexRecord &a = motion.position[r], &b = motion.position[r + 1];
      const VertexRecord &u = motion.velocity[r], &v = motion.velocity[r + 1];
      const double x = b.x - a.x, y = b.y - a.y, z = b.z - a.z;
      const double length = std::sqrt(x * x + y * y + z * z);
      const double rate = ((v.x - u.x) * x + (v.y - u.y) * y + (v.z - u.z) * z) / length;
      const double pull = (stiffness_ * (length - rest_) + damping_ * rate) / length;
      force[r].x += pull * x, force[r].y += pull * y, force[r].z += pull * z;
      force[r + 1].x -= pull * x, force[r + 1].y -= pull * y, force[r + 1].z -= pull * z;
    }
    return true;
  }
  bool potential_energy(const Motion& motion, double, double& energy) override {
    energy = 0;
    for (std::size_t r = 0; r < motion.position.size(); ++r) {
      energy += weight_ * motion.position[r].z;
      if (r + 1 == motion.position.size()) break;
      const VertexRecord &a = motion.position[r], &b = motion.position[r + 1];
      const double length = std::hypot(b.x - a.x, b.y - a.y, b.z - a.z);
      energy += 0.5 * stiffness_ * (length - rest_) * (length - rest_);
    }
    return true;
  }
  bool reads_velocity() const override { return damping_ != 0; }

 private:
  double stiffness_, rest_, damping_, weight_;
};
/// The chain that tests of a whole simulation hang up.
inline std::unique_ptr<engine::ForceField> springs() {
  return std::make_unique<SpringChain>(20, 0.5, 0.02, 0.1, 9.81);
}

/// A function of position, velocity and time on every vertex.
class ForcesOf final : public HandWrittenForces {
 public:
  using Function = std::function<VertexRecord(const VertexRecord& x, const VertexRecord& v, double t)>;
  explicit ForcesOf(Function function) : function_(std::move(function)) {}
  bool evaluate(const Motion& motion, double time, double, std::span<VertexRecord> force) override {
    for (std::size_t r = 0; r < force.size(); ++r)
      force[r] = function_(motion.position[r], motion.velocity[r], time);
    return true;
  }
  bool reads_time() const override { return true; }

 private:
  Function function_;
};

}  // namespace gmsim::tests
