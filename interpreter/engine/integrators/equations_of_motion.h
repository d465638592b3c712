// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/force_field.h"
#include "engine/integrators/phase_point.h"
#include "engine/integrators/prescribed_motion.h"
#include "support/diagnostic.h"

namespace gmsim::engine {

/// Where forces are evaluated: within a step, or at its end, which is where the next one begins.
enum class Stage : std::uint8_t { Within, End };

/// Newton's second law for all vertices, and what moves by decree instead. Borrows both.
class EquationsOfMotion {
 public:
  EquationsOfMotion(ForceField& field, PrescribedMotions& prescribed)
      : field_(field), prescribed_(prescribed) {}

  /// 1/kg by row; 0 for vertices that forces cannot move (fixed, prescribed) and for dead rows.
  void set_inverse_mass(std::vector<double> inverse_mass) {
    inverse_mass_ = std::move(inverse_mass);
  }
  /// The same of one row, perhaps a new one.
  void set_inverse_mass(gmap::Row row, double inverse_mass) {
    if (row >= inverse_mass_.size()) inverse_mass_.resize(row + std::size_t{1});
    inverse_mass_[row] = inverse_mass;
  }
  [[nodiscard]] std::span<const double> inverse_mass() const { return inverse_mass_; }

  /// Prescribed motion starts from here; to be called before the stages of a step.
  void begin_step(const PhasePoint& now) { prescribed_.begin_step(now); }
  /// Puts prescribed vertices where they are at `time`, then evaluates all forces there.
  bool evaluate(Motion& motion, double time, double dt, std::span<VertexRecord> force,
                Stage stage);
  /// Puts prescribed vertices where they are at `time`, with their velocities.
  bool prescribe(double time, Motion& motion) { return prescribed_.apply(time, motion); }
  /// The forces only.
  bool evaluate_forces(const Motion& motion, double time, double dt, std::span<VertexRecord> force,
                       Stage stage);

  /// work(begin, end) for ranges of the rows 0 … rows-1, on all threads that evaluate forces.
  template <typename Work>
  void for_rows(std::size_t rows, const Work& work) const {
    field_.share_rows(
        static_cast<Row>(rows),
        [](const void* context, Row begin, Row end) {
          (*static_cast<const Work*>(context))(begin, end);
        },
        &work);
  }

  [[nodiscard]] bool reads_velocity() const { return field_.reads_velocity(); }
  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }
  /// Why the last evaluation failed.
  [[nodiscard]] const std::optional<support::Diagnostic>& error() const;

 private:
  ForceField& field_;
  PrescribedMotions& prescribed_;
  std::vector<double> inverse_mass_;
  std::uint64_t evaluations_ = 0;
};

}  // namespace gmsim::engine
