// SPDX-License-Identifier: MIT
#pragma once

#include <set>

#include "gmap/embedding_schema.h"
#include "types/expr.h"

namespace gmsim::scene {

/// The expression has one value, whatever the dart, the state and the time: it reads no local that
/// it does not bind itself.
[[nodiscard]] bool is_constant(const types::Expr& expr);

/// Adds every embedding that it reads, itself or through derived values and the weights of splits.
void add_reads(const types::Expr& expr, const gmap::EmbeddingSchema& schema,
               std::set<types::EmbeddingId>& reads);
void add_read(types::EmbeddingId id, const gmap::EmbeddingSchema& schema,
              std::set<types::EmbeddingId>& reads);

}  // namespace gmsim::scene
