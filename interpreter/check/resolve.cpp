// SPDX-License-Identifier: MIT
#include "check/resolve.h"

#include <algorithm>
#include <cmath>

#include "check/make_expr.h"
#include "support/suggest.h"

namespace gmsim::check {
using support::DiagnosticKind;
namespace {

/// Components of the largest array a value may be.
constexpr std::uint64_t kLargestArray = 4096;

std::string in_dimension(int n) { return " in dimension " + std::to_string(n); }

/// The entries of a label or orbit as numbers, kBlank for `_`.
std::optional<std::vector<LabelEntry>> resolve_entries(ItemContext& context,
                                                       const syntax::OrbitExpr& orbit) {
  std::vector<LabelEntry> entries;
  for (const syntax::OrbitEntry& entry : orbit.entries) {
    if (entry.kind == syntax::OrbitEntry::Kind::Blank) {
      entries.push_back(kBlank);
      continue;
    }
    const int first = entry.first.in(context.n());
    const bool range = entry.kind == syntax::OrbitEntry::Kind::Range;
    const int last = range ? entry.last.in(context.n()) : first;
    if (range && first > last) continue;
    if (!resolve_link(context, entry.first, DiagnosticKind::LinkDimension)) return std::nullopt;
    if (range && !resolve_link(context, entry.last, DiagnosticKind::LinkDimension))
      return std::nullopt;
    for (int i = first; i <= last; ++i) entries.push_back(static_cast<LabelEntry>(i));
  }
  return entries;
}

std::vector<std::string> orbit_names(const ItemContext& context) {
  std::vector<std::string> names;
  for (const OrbitName& orbit : context.env.library->orbits) names.push_back(orbit.name);
  return names;
}

}  // namespace

std::optional<int> resolve_link(ItemContext& context, const syntax::LinkDimension& link,
                                DiagnosticKind kind) {
  const int i = link.in(context.n());
  if (i >= 0 && i <= context.n()) return i;
  context.absent(kind, link.span,
                 "there is no link " + std::to_string(i) + in_dimension(context.n()));
  return std::nullopt;
}

bool names_orbit(const ItemContext& context, const std::string& name) {
  return context.env.library->find_orbit(name) || is_predeclared_orbit(name) ||
         context.env.items->find(NameSpace::Orbits, name, context.n());
}

std::optional<OrbitType> resolve_orbit_name(ItemContext& context, const syntax::Name& name) {
  if (const auto orbit = context.env.library->find_orbit(name.text)) return orbit;
  if (const auto item = context.env.items->find(NameSpace::Orbits, name.text, context.n())) {
    // Declared, but not there: absent or failed.
    if (context.require(*item, name.span)) context.poison();
    return std::nullopt;
  }
  if (is_predeclared_orbit(name.text)) {
    context.absent(DiagnosticKind::Dimension, name.span,
                   "there is no orbit `" + name.text + "`" + in_dimension(context.n()));
    return std::nullopt;
  }
  context.report_unknown({.kind = DiagnosticKind::UnknownOrbit,
                          .message = "no orbit named `" + name.text + "`",
                          .place = name.span,
                          .help = support::did_you_mean(name.text, orbit_names(context))});
  return std::nullopt;
}

std::optional<OrbitType> resolve_orbit(ItemContext& context, const syntax::OrbitExpr& orbit) {
  if (orbit.name) return resolve_orbit_name(context, *orbit.name);
  for (const syntax::OrbitEntry& entry : orbit.entries)
    if (entry.kind == syntax::OrbitEntry::Kind::Blank) {
      context.report({.kind = DiagnosticKind::BadItem,
                      .message = "`_` stands in the labels of nodes only",
                      .place = entry.span});
      return std::nullopt;
    }
  const auto entries = resolve_entries(context, orbit);
  if (!entries) return std::nullopt;
  OrbitType type;
  for (const LabelEntry i : *entries) {
    if (type.contains(i)) {
      context.report({.kind = DiagnosticKind::DuplicateDimension,
                      .message = "link " + std::to_string(i) + " stands twice in this orbit",
                      .place = orbit.span});
      return std::nullopt;
    }
    type.insert(i);
  }
  return type;
}

std::optional<std::vector<LabelEntry>> resolve_label(ItemContext& context,
                                                     const syntax::OrbitExpr& label) {
  return resolve_entries(context, label);
}

std::optional<types::NamedUnit> resolve_unit(ItemContext& context, const syntax::UnitExpr& unit) {
  types::NamedUnit product;
  for (const syntax::UnitFactor& factor : unit.factors) {
    const auto named = types::named_unit(factor.name.text);
    if (!named) {
      context.report(
          {.kind = DiagnosticKind::UnknownUnit,
           .message = "no unit named `" + factor.name.text + "`",
           .place = factor.name.span,
           .help = support::did_you_mean(factor.name.text, types::unit_names())});
      return std::nullopt;
    }
    const auto power = types::power(named->unit, factor.numerator, factor.denominator);
    if (!power) {
      context.report({.kind = DiagnosticKind::UnitMismatch,
                      .message = "`" + factor.name.text + "` has no such power",
                      .place = factor.name.span});
      return std::nullopt;
    }
    product.unit = product.unit * *power;
    if (named->scale != 1.0)
      product.scale *= std::pow(named->scale,
                                static_cast<double>(factor.numerator) / factor.denominator);
  }
  if (!std::isfinite(product.scale) || product.scale == 0.0) {
    context.report({.kind = DiagnosticKind::BadNumber,
                    .message = "this unit is out of range",
                    .place = unit.span});
    return std::nullopt;
  }
  return product;
}

std::optional<ResolvedType> resolve_type(ItemContext& context, const syntax::TypeExpr& type) {
  const auto kind = types::value_kind(type.name.text);
  if (!kind) {
    const std::vector<std::string> names = types::value_type_names();
    std::string help = support::did_you_mean(type.name.text, names);
    if (help.empty()) {
      help = "types are ";
      for (const std::string& name : names) help += (&name == &names[0] ? "`" : ", `") + name + "`";
    }
    context.report({.kind = DiagnosticKind::UnknownType,
                    .message = "no type named `" + type.name.text + "`",
                    .place = type.name.span,
                    .help = help});
    return std::nullopt;
  }
  ResolvedType resolved{.type = {*kind, type.extents}, .unit = {}};
  std::uint64_t size = types::component_count(ValueType{*kind});
  for (const std::uint32_t extent : type.extents) {
    if (extent < 2 || size * extent > kLargestArray) {
      context.report({.kind = DiagnosticKind::BadIndex,
                      .message = extent < 2 ? "an array has at least 2 elements"
                                            : "an array holds at most " +
                                                  std::to_string(kLargestArray) + " numbers",
                      .place = type.span});
      return std::nullopt;
    }
    size *= extent;
  }
  if (!type.unit) return resolved;
  const auto unit = resolve_unit(context, *type.unit);
  if (!unit) return std::nullopt;
  if (*kind == ValueKind::Bool) {
    context.report({.kind = DiagnosticKind::UnitMismatch,
                    .message = "a bool has no unit",
                    .place = type.unit->span});
    return std::nullopt;
  }
  resolved.unit = unit->unit;
  resolved.scale = unit->scale;
  return resolved;
}

std::string orbit_text(OrbitType orbit, int dimension) {
  for (const OrbitName& name : predeclared_orbits(dimension))
    if (name.orbit == orbit) return name.name;
  return to_string(orbit);
}

}  // namespace gmsim::check
