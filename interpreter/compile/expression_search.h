// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "gmap/embedding_schema.h"
#include "types/expr.h"

namespace gmsim::compile {

/// Is there a node for which `wanted` holds, in the expression or in the derived values that it reads?
[[nodiscard]] bool any_node(const types::Expr& expr, const gmap::EmbeddingSchema& schema,
                            const std::function<bool(const types::Expr&)>& wanted);

/// It reads forces, one by one or their sums.
[[nodiscard]] bool reads_forces(const types::Expr& expr, const gmap::EmbeddingSchema& schema);

/// It reads the clock (time, step, dt), itself or through derived values.
[[nodiscard]] bool reads_clock(const types::Expr& expr, const gmap::EmbeddingSchema& schema);

}  // namespace gmsim::compile
