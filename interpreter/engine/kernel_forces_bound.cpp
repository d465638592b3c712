// SPDX-License-Identifier: MIT
// KernelForces: the stiffness and damping of every match, and what they say about the step.
#include <algorithm>
#include <array>

#include "engine/kernel_forces.h"

namespace gmsim::engine {

namespace {

constexpr std::uint32_t kMatches = 256;  // whose matrices are held at a time

using Direction = std::array<double, 4>;
constexpr Direction kNone{};
constexpr std::array<Direction, 3> kAxes{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

/// The changes of all vertices as inputs: along one axis at one of them.
void set_changes(const ForceKernel& kernel, std::uint32_t role, std::uint32_t axis,
                 bool of_velocity, std::vector<InputBinding>& inputs) {
  const auto kind =
      of_velocity ? InputOrigin::Kind::VelocityChange : InputOrigin::Kind::PositionChange;
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const InputOrigin& origin = kernel.origin(k);
    if (origin.kind != InputOrigin::Kind::VelocityChange &&
        origin.kind != InputOrigin::Kind::PositionChange)
      continue;
    const bool moves = origin.kind == kind && origin.role == role;
    inputs[k] = {moves ? kAxes[axis].data() : kNone.data()};
  }
}

}  // namespace

bool KernelForces::add_bounds(InteractionTables& of, std::size_t shape, const ForceMoment& moment,
                              bool of_velocity, ElementBounds& bounds) {
  const MatchTable& table = of.table(shape);
  const auto& roots = of.shape(shape).forces;
  const ForceKernel& kernel = of.kernels(shape).product();
  const std::size_t n = 3 * roots.size();
  std::vector<InputBinding> inputs;
  kernel.bind(table, context_.state.store, moment, inputs);
  std::vector<double> columns(std::size_t{kMatches} * n * n);  // by column, root, match, entry
  std::vector<double> matrix(n * n);
  KernelScratch& space = workers_.spaces[0].scratch;
  const std::size_t outputs = kernel.kernel().outputs.size();
  const auto entry = [&](std::size_t root, std::size_t column, std::uint32_t match, std::size_t axis) {
    const auto [output, negative] = kernel.root(root);
    const double value = columns[((column * outputs + output) * kMatches + match) * 3 + axis];
    return negative ? -value : value;
  };
  for (std::uint32_t begin = 0; begin < table.size(); begin += kMatches) {
    const std::uint32_t end = std::min(table.size(), begin + kMatches);
    for (std::uint32_t column = 0; column < n; ++column) {
      set_changes(kernel, roots[column / 3].role, column % 3, of_velocity, inputs);
      std::vector<OutputBinding> bindings;
      for (std::size_t output = 0; output < outputs; ++output) {
        // Outputs are addressed from match 0 on; only this part of the matches is written.
        double* first = columns.data() + (column * outputs + output) * kMatches * 3;
        bindings.push_back({first - std::ptrdiff_t{3} * begin, 3});
      }
      if (const auto row = kernel.run(table, inputs, bindings, begin, end, space))
        return fail(of, static_cast<std::uint32_t>(shape), *row, kernel.program(), moment);
    }
    for (std::uint32_t row = begin; row < end; ++row) {
      if (table.vacant(row)) continue;
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          matrix[i * n + j] = -entry(i / 3, j, row - begin, i % 3);
      bounds.add(of.number(), table.key(row), bounds.stand(of.shape(shape), table.targets(row)),
                 matrix);
    }
  }
  return true;
}

bool KernelForces::element_bound(const Motion& motion, double time, ElementBound& bound) {
  if (error_) return false;
  const ForceMoment now = moment(motion, time, context_.state.dt);
  const auto largest = [&](bool of_velocity, ElementBounds::Largest& result) {
    ElementBounds bounds(context_);
    for (const auto& of : interactions_)
      for (std::size_t shape = 0; shape < of->shape_count(); ++shape)
        if (!add_bounds(*of, shape, now, of_velocity, bounds)) return false;
    result = bounds.largest();
    return true;
  };
  ElementBounds::Largest stiffness, damping;
  if (!largest(false, stiffness) || (reads_velocity() && !largest(true, damping))) return false;
  bound = {.stiffness = stiffness.value,
           .damping = damping.value,
           .where = stiffness.where,
           .interaction = stiffness.interaction};
  return true;
}

}  // namespace gmsim::engine
