// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compile/ir.h"
#include "compile/specialise.h"
#include "engine/force_field.h"
#include "engine/force_inputs.h"

namespace gmsim::engine {

struct ForceReadings;

/// What an evaluation depends on besides the store: rows of the vertex index.
struct ForceMoment {
  std::span<const VertexRecord> position;          ///< m
  std::span<const VertexRecord> velocity;          ///< m/s
  std::span<const VertexRecord> position_change = {};
  std::span<const VertexRecord> velocity_change = {};
  double time = 0;  ///< s
  double dt = 0;    ///< s
  double step = 0;  ///< steps completed
  const ForceReadings* forces = nullptr;  ///< what criteria and fields read
};

/// Something to compute of every match of a shape: a graph, its roots, and where the inputs that
/// these depend on come from.
struct ForceProgram {
  struct LiveInput {
    std::uint32_t number = 0;  ///< in graph.inputs()
    InputOrigin origin;
  };
  compile::ir::Graph graph;
  std::vector<compile::ir::NodeId> roots;
  std::vector<LiveInput> inputs;

  [[nodiscard]] bool reads(InputOrigin::Kind kind) const;
};

// Where a shape has a condition that does not hold, all results are zero.

/// The force on each vertex of Shape::forces, in order (N).
[[nodiscard]] ForceProgram force_program(const compile::Shape& shape, const ShapeInputs& inputs);
/// The parts of the values number first .. first + count - 1 of a shape, one after another.
[[nodiscard]] ForceProgram values_program(const compile::Shape& shape, const ShapeInputs& inputs,
                                          std::size_t first, std::size_t count);
/// One root, the energy (J); no root when the shape has none.
[[nodiscard]] ForceProgram energy_program(const compile::Shape& shape, const ShapeInputs& inputs);
/// The derivative of each root of a force program along a change of all positions and velocities,
/// which are inputs of the kinds PositionChange and VelocityChange.
[[nodiscard]] ForceProgram product_program(const ForceProgram& force);
/// One root, 1 where a force or the energy needs the direction of a vector that has no length, else
/// 0; no root when that cannot be. Only vectors between positions count: a velocity may be zero.
[[nodiscard]] ForceProgram direction_program(const compile::Shape& shape,
                                             const ShapeInputs& inputs);

}  // namespace gmsim::engine
