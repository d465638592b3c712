// SPDX-License-Identifier: MIT
#pragma once

#include "check/item_context.h"
#include "check/resolve.h"

namespace gmsim::check {

/// How a value behaves when its orbit splits or merges.
struct ValueBehaviour {
  gmap::EmbeddingKind kind = gmap::EmbeddingKind::Intensive;
  gmap::MergePolicy merge = gmap::MergePolicy::None;
};

/// From `intensive`, `extensive`, `merge …` as written; reports what contradicts itself or the type.
[[nodiscard]] ValueBehaviour resolve_behaviour(ItemContext& context,
                                               const syntax::KindClause& kind,
                                               const std::optional<syntax::MergeClause>& merge,
                                               const ResolvedType& type);

/// Checks the `split EXPR` of an extensive value. It speaks of one part: `dart` names a dart of it
/// (`a` where the declaration names none), and a bare embedding is read there.
void check_weight(Environment& environment, const support::SourceMap& sources,
                  const syntax::KindClause& kind, const syntax::Name& dart,
                  gmap::EmbeddingDecl& declaration, ItemContext& report_to);

}  // namespace gmsim::check
