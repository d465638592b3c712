// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "compile/ir.h"
#include "compile/specialise.h"
#include "engine/state.h"

namespace gmsim::engine {

/// Evaluates every node of a graph, one match at a time: slow, simple, and the reference for the
/// block kernels. `Number` is double (the rounding that kernels must have) or long double (to judge
/// rounding and derivatives; eigenvalues and polar rotations are computed in double there too).
template <typename Number>
class IrEvaluator {
 public:
  using Ir = compile::ir::Graph;
  using NodeId = compile::ir::NodeId;
  /// Entries of a value: 1 of a number or mask (0 or 1), 3 of a vector, 9 of a matrix by rows, 6 of
  /// a symmetric one (xx, yy, zz, yz, xz, xy).
  using Entries = std::array<Number, 9>;

  explicit IrEvaluator(const Ir& graph);

  /// The value of an input by its number in graph.inputs(), as many entries as its nodes have.
  void set_input(std::uint32_t input, std::span<const Number> entries);
  /// Computes all nodes from the inputs.
  void run();
  [[nodiscard]] const Entries& operator[](NodeId id) const {
    return values_[compile::ir::index(id)];
  }
  [[nodiscard]] Number number(NodeId id) const { return (*this)[id][0]; }

 private:
  void scalar(const compile::ir::Node& node, Number& out) const;
  void tensor(const compile::ir::Node& node, Entries& out) const;

  const Ir& graph_;
  std::vector<Entries> inputs_;
  std::vector<Entries> values_;
};

/// Sets the inputs of a shape from a state, for the match with these roles. Columns that the store
/// lacks are computed by the tree evaluator.
template <typename Number>
void gather_inputs(const compile::Shape& shape, std::span<const compile::Role> roles,
                   const State& state, IrEvaluator<Number>& evaluator);

extern template class IrEvaluator<double>;
extern template class IrEvaluator<long double>;

}  // namespace gmsim::engine
