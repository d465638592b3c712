// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <utility>

#include "engine/integrators/integrator.h"
#include "engine/integrators/test_equation.h"
#include "engine/integrators/vertex_record_math.h"

namespace gmsim::engine {

/// An explicit Runge-Kutta method on (x, v). The tableau is a type with
///   kStages, kEmbeddedOrder (0: none)
///   kA[kStages][kStages], kB[kStages], kC[kStages]
///   kE[kStages + 1]  solution minus embedded solution; the last is the stage at the end of the step
/// whose zeros cost nothing. The velocities of a stage are its derivatives of positions, its forces
/// over mass those of velocities.
template <typename Tableau>
class RungeKutta final : public Integrator {
 public:
  void resize(std::size_t rows) override {
    trial_.position.resize(rows);
    trial_.velocity.resize(rows);
    for (auto& stage : velocity_) stage.resize(rows);
    for (auto& stage : force_) stage.resize(rows);
  }

  bool advance(EquationsOfMotion& equations, const PhasePoint& now, double dt,
               PhasePoint& next) override {
    rates_[0] = {now.motion.velocity.data(), now.force.data()};
    if (!stages(equations, now, dt, std::make_index_sequence<kStages - 1>{})) return false;
    combine<Tableau::kB>(equations, now, dt, next.motion, std::make_index_sequence<kStages>{});
    next.time = now.time + dt;
    return equations.evaluate(next.motion, next.time, dt, next.force, Stage::End);
  }

  double error_norm(const EquationsOfMotion& equations, const PhasePoint& now,
                    const PhasePoint& next, double dt, const Tolerance& tolerance) const override {
    if constexpr (Tableau::kEmbeddedOrder == 0) {
      return 0;
    } else {
      const std::span<const double> inverse_mass = equations.inverse_mass();
      double sum = 0;
      std::size_t count = 0;
      for (std::size_t r = 0; r < now.rows(); ++r) {
        if (inverse_mass[r] == 0) continue;
        VertexRecord dx = Tableau::kE[kStages] * next.motion.velocity[r];
        VertexRecord df = Tableau::kE[kStages] * next.force[r];
        for (std::size_t j = 0; j < kStages; ++j) {
          dx = dx + Tableau::kE[j] * rates_[j].velocity[r];
          df = df + Tableau::kE[j] * rates_[j].force[r];
        }
        sum += squares(dt * dx, now.motion.position[r], next.motion.position[r],
                       tolerance.relative, tolerance.position);
        sum += squares(dt * inverse_mass[r] * df, now.motion.velocity[r], next.motion.velocity[r],
                       tolerance.relative, tolerance.velocity);
        count += 6;
      }
      return count == 0 ? 0 : std::sqrt(sum / static_cast<double>(count));
    }
  }

  int embedded_order() const override { return Tableau::kEmbeddedOrder; }

  double growth(double z, double zeta) const override {
    return polynomial_growth(kPolynomial, z, zeta);
  }

 private:
  static constexpr std::size_t kStages = Tableau::kStages;
  struct Rates {
    const VertexRecord* velocity = nullptr;
    const VertexRecord* force = nullptr;
  };

  /// R(w) = 1 + sum_k w^(k+1) b^T A^k 1.
  static constexpr std::array<double, kStages + 1> stability_polynomial() {
    std::array<double, kStages + 1> polynomial{};
    std::array<double, kStages> power{};
    power.fill(1);
    polynomial[0] = 1;
    for (std::size_t k = 0; k < kStages; ++k) {
      std::array<double, kStages> next{};
      for (std::size_t i = 0; i < kStages; ++i) {
        polynomial[k + 1] += Tableau::kB[i] * power[i];
        for (std::size_t j = 0; j < i; ++j) next[i] += Tableau::kA[i][j] * power[j];
      }
      power = next;
    }
    return polynomial;
  }
  static constexpr std::array<double, kStages + 1> kPolynomial = stability_polynomial();

  template <std::size_t... S>
  bool stages(EquationsOfMotion& equations, const PhasePoint& now, double dt,
              std::index_sequence<S...>) {
    return (stage<S + 1>(equations, now, dt) && ...);
  }

  template <std::size_t S>
  bool stage(EquationsOfMotion& equations, const PhasePoint& now, double dt) {
    combine<Tableau::kA[S]>(equations, now, dt, trial_, std::make_index_sequence<S>{});
    const double time = now.time + Tableau::kC[S] * dt;
    if (!equations.evaluate(trial_, time, dt, force_[S - 1], Stage::Within)) return false;
    std::swap(trial_.velocity, velocity_[S - 1]);
    rates_[S] = {velocity_[S - 1].data(), force_[S - 1].data()};
    return true;
  }

  /// out := now + dt (weights . rates of the first stages).
  template <const auto& Weights, std::size_t... J>
  void combine(const EquationsOfMotion& equations, const PhasePoint& now, double dt, Motion& out,
               std::index_sequence<J...>) const {
    const std::size_t rows = now.rows();
    const double* const inverse_mass = equations.inverse_mass().data();
    const VertexRecord* const x0 = now.motion.position.data();
    const VertexRecord* const v0 = now.motion.velocity.data();
    const std::array<Rates, sizeof...(J)> rates = {rates_[J]...};
    VertexRecord* const x = out.position.data();
    VertexRecord* const v = out.velocity.data();
    equations.for_rows(rows, [=](std::size_t begin, std::size_t end) {
      for (std::size_t r = begin; r < end; ++r) {
        VertexRecord dx, df;
        (add<Weights[J]>(rates[J], r, dx, df), ...);
        x[r] = x0[r] + dt * dx;
        v[r] = v0[r] + dt * inverse_mass[r] * df;
      }
    });
  }
  template <double Weight>
  static void add(const Rates& rates, std::size_t row, VertexRecord& dx, VertexRecord& df) {
    if constexpr (Weight != 0) {
      dx = dx + Weight * rates.velocity[row];
      df = df + Weight * rates.force[row];
    }
  }

  static double squares(const VertexRecord& error, const VertexRecord& from, const VertexRecord& to,
                        double relative, double absolute) {
    const auto part = [&](double e, double a, double b) {
      const double ratio = e / (absolute + relative * std::max(std::abs(a), std::abs(b)));
      return ratio * ratio;
    };
    return part(error.x, from.x, to.x) + part(error.y, from.y, to.y) + part(error.z, from.z, to.z);
  }

  Motion trial_;
  std::array<std::vector<VertexRecord>, kStages - 1> velocity_, force_;
  std::array<Rates, kStages> rates_;
};

}  // namespace gmsim::engine
