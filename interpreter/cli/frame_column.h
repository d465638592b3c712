// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/state.h"
#include "engine/tree_eval.h"
#include "io/trajectory_writer.h"
#include "scene/scene.h"
#include "support/diagnostic.h"

namespace gmsim::cli {

/// One field of the output: its description, and its values in the frame at hand. Evaluated from
/// the expression tree, so that what is looked at has no part in what is simulated.
class FrameColumn {
 public:
  /// Puts the value at a dart into `out`; false after a failure, which the evaluator keeps.
  using Read =
      std::function<bool(engine::TreeEvaluator&, engine::DartId, std::span<double> out)>;

  /// `description.orbit` is filled in from `orbit`, the type of orbit that has one value each.
  FrameColumn(io::FieldDescription description, types::OrbitType orbit, Read read);
  /// What a scene asks for.
  FrameColumn(const scene::OutputField& field, int dimension);

  [[nodiscard]] const io::FieldDescription& description() const { return description_; }
  [[nodiscard]] types::OrbitType orbit() const { return orbit_; }
  /// Evaluates at the darts, one of each row. An optional value that an orbit lacks is not a
  /// number in a real field, and the smallest number there is in one of whole numbers. Any other
  /// expression without a value is reported, and false.
  bool evaluate(engine::TreeEvaluator& evaluator, std::span<const engine::DartId> darts,
                support::Diagnostics& diagnostics);
  /// Refers to this column until the next evaluation; Unchanged when it has what it had before.
  [[nodiscard]] io::FrameField frame_field() const;

 private:
  bool read_row(engine::TreeEvaluator& evaluator, engine::DartId dart, std::span<double> out,
                support::Diagnostics& diagnostics);
  void store(std::span<const double> values);

  io::FieldDescription description_;
  types::OrbitType orbit_;
  Read read_;
  std::vector<std::int32_t> darts_;
  std::vector<double> doubles_;
  std::vector<float> floats_;
  std::vector<std::int32_t> integers_;
  std::vector<double> values_;  // as evaluated
  bool unchanged_ = false;
};

}  // namespace gmsim::cli
