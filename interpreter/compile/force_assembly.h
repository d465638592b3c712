// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "compile/specialise.h"
#include "compile/symbolic_walker.h"

namespace gmsim::compile {

/// Gathers the force lines of an item at one match into one total for each vertex.
class ForceAssembly {
 public:
  ForceAssembly(SymbolicWalker& walker, ir::Graph* graph) : walker_(walker), graph_(graph) {}

  /// Targets and explicit parts of all lines.
  void add_lines(const std::vector<BodyForce>& lines);
  /// total = explicit parts - gradient of the energy (kNone: none). Positions that the energy
  /// depends on without a force line fail: momentum would be lost.
  void finish(ir::NodeId energy, Span energy_span, Shape& shape);
  [[nodiscard]] std::vector<DartId> take_darts() { return std::move(darts_); }

 private:
  void add_target(const BodyForce& line, std::uint32_t number, DartRef target,
                  ir::NodeId explicit_part);
  [[nodiscard]] ir::NodeId explicit_part(const BodyForce& line);
  /// a + b; of two multiples of one vector the multiple by the sum of their factors.
  [[nodiscard]] ir::NodeId sum(ir::NodeId a, ir::NodeId b);
  /// Derivatives of the energy by the positions. When it depends on them through one number alone
  /// that the item differentiates itself (an angle, for its damping), those derivatives are shared.
  [[nodiscard]] std::vector<ir::NodeId> gradient(ir::NodeId energy,
                                                 const std::vector<ir::NodeId>& positions);
  void subtract_gradient(ir::NodeId energy, Span energy_span);

  SymbolicWalker& walker_;
  ir::Graph* graph_;
  std::vector<ForceRoot> roots_;
  std::vector<ForceTarget> targets_;
  std::vector<DartId> darts_;
};

}  // namespace gmsim::compile
