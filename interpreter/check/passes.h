// SPDX-License-Identifier: MIT
#pragma once

#include "check/checked_rule.h"
#include "support/diagnostic.h"

/// The passes over one checked rule. Each reports and returns whether the rule is still good.
namespace gmsim::check {

/// C1-C8 of docs/theory.md: the rule keeps every map a map.
bool check_topology(const Rule& rule, support::Diagnostics& diagnostics);

/// C1-C6, without a report: the rule says something that can be done to a map.
[[nodiscard]] bool is_well_formed(const Rule& rule);

/// E1-E6: after the rule every orbit has exactly one value for each embedding of the schema.
/// Call only for rules that pass check_topology.
bool check_embeddings(const Rule& rule, const gmap::EmbeddingSchema& schema,
                      support::Diagnostics& diagnostics);

/// C1, C3, C5, C6 for a pattern that is only matched (interactions, criteria), rooted at one node.
bool check_match(const Pattern& match, NodeIndex hook, int dimension,
                 support::Diagnostics& diagnostics);

/// Fills `footprint` from the parts of an item.
[[nodiscard]] Footprint footprint(const Rule& rule);
[[nodiscard]] Footprint footprint(const Interaction& interaction);
[[nodiscard]] Footprint footprint(const Criterion& criterion);
/// Needs the footprints of the rules and operations it applies.
[[nodiscard]] Footprint footprint(const Operation& operation, const RuleLibrary& library);

}  // namespace gmsim::check
