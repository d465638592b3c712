// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "check/item_context.h"
#include "types/unit.h"

/// From what is written to what is meant in this dimension of the map: link dimensions, orbits,
/// labels, units and types. Each reports and returns nothing when there is no meaning.
namespace gmsim::check {

/// A link dimension of the map; `kind` says how to report one that the map lacks.
[[nodiscard]] std::optional<int> resolve_link(ItemContext& context,
                                              const syntax::LinkDimension& link,
                                              support::DiagnosticKind kind);
/// An orbit type, named or literal.
[[nodiscard]] std::optional<OrbitType> resolve_orbit(ItemContext& context,
                                                     const syntax::OrbitExpr& orbit);
/// The orbit of a bare name.
[[nodiscard]] std::optional<OrbitType> resolve_orbit_name(ItemContext& context,
                                                          const syntax::Name& name);
/// Whether the name means an orbit, here or in another dimension.
[[nodiscard]] bool names_orbit(const ItemContext& context, const std::string& name);
/// The word of a node's label.
[[nodiscard]] std::optional<std::vector<LabelEntry>> resolve_label(ItemContext& context,
                                                                   const syntax::OrbitExpr& label);

[[nodiscard]] std::optional<types::NamedUnit> resolve_unit(ItemContext& context,
                                                           const syntax::UnitExpr& unit);

struct ResolvedType {
  types::ValueType type;
  types::MaybeUnit unit;
  double scale = 1.0;  ///< SI units per declared unit
};
[[nodiscard]] std::optional<ResolvedType> resolve_type(ItemContext& context,
                                                       const syntax::TypeExpr& type);

/// "vertex" where an orbit type has a name, else "<0,3>".
[[nodiscard]] std::string orbit_text(OrbitType orbit, int dimension);

}  // namespace gmsim::check
