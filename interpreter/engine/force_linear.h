// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "compile/ir.h"

/// What merging has to know of a graph: found from its operations alone, so an answer is a proof.
namespace gmsim::engine {

/// Are all roots sums of terms with exactly one factor among the inputs for which `summed` holds?
/// Then f(a + b) = f(a) + f(b) in them. `summed` by number in graph.inputs().
[[nodiscard]] bool linear_in(const compile::ir::Graph& graph,
                             std::span<const compile::ir::NodeId> roots,
                             const std::vector<bool>& summed);

/// Does root `a`, with each input replaced by its partner, equal root `b`? Says yes only when this
/// follows from signs and the order of sums and products. `partner` by number in graph.inputs().
[[nodiscard]] bool equal_when_exchanged(const compile::ir::Graph& graph, compile::ir::NodeId a,
                                        compile::ir::NodeId b,
                                        const std::vector<std::uint32_t>& partner);

}  // namespace gmsim::engine
