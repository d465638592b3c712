// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "check/item_context.h"
#include "check/load_rules.h"

/// One function for each kind of item: from the tree to the checked form, in one dimension. Problems
/// are kept in the context; the caller looks at `context.good()`.
namespace gmsim::check {

// ---- values -------------------------------------------------------------------------------------

/// Name, type, orbit and behaviour of an embedding or derived value.
[[nodiscard]] gmap::EmbeddingDecl declare_value(ItemContext& context, const ItemEntry& entry);
/// Default and weight of an embedding, or the expression of a derived value.
void complete_value(ItemContext& context, const ItemEntry& entry, gmap::EmbeddingDecl& value);
/// Derived values that are computed from themselves; reports each cycle once, at its first member in
/// the order of the schema. Returns the values that are part of one.
[[nodiscard]] std::vector<EmbeddingId> find_derived_cycles(const gmap::EmbeddingSchema& schema,
                                                           support::Diagnostics& diagnostics);

// ---- interactions and families ------------------------------------------------------------------

/// An interaction between its declaration and its body.
struct InteractionDraft {
  InteractionDraft(ItemIndex index, Environment& environment, const support::SourceMap& sources)
      : item(index), context(environment, sources) {}
  ItemIndex item;
  ItemContext context;
  Interaction result;
  std::vector<gmap::EmbeddingDecl> values;  ///< presence, parameters, results; for the schema
};
/// Orbit, pattern and the values it stores.
void declare_interaction(InteractionDraft& draft);
/// Everything else. `first_value` is the schema's number of the presence mark.
void complete_interaction(InteractionDraft& draft, EmbeddingId first_value);

[[nodiscard]] Family check_family(ItemContext& context, const ItemEntry& entry);

// ---- rules, criteria, operations ----------------------------------------------------------------

[[nodiscard]] Rule check_rule(ItemContext& context, const ItemEntry& entry);
/// `of`: the interaction that a criterion belongs to, which is checked already.
[[nodiscard]] Criterion check_criterion(ItemContext& context, const ItemEntry& entry,
                                        const InteractionDraft* of);
/// What an operation applies must be checked already.
[[nodiscard]] Operation check_operation(ItemContext& context, const ItemEntry& entry);
/// Rules and operations that an operation applies, in the order of the text.
[[nodiscard]] std::vector<const syntax::Name*> applied_names(const syntax::OperationItem& item);

/// E1-E6 of a rule against the embeddings of particles.rule, of the rule's file and its imports, and
/// whatever else the rule names.
void check_rule_embeddings(const Rule& rule, const ItemEntry& entry, const LoadedRules& files,
                           const gmap::EmbeddingSchema& schema,
                           support::Diagnostics& diagnostics);

}  // namespace gmsim::check
