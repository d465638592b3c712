// SPDX-License-Identifier: MIT
#include "scene/quantity.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "scene/mapped_text.h"
#include "support/check.h"
#include "support/suggest.h"
#include "syntax/parse.h"

namespace gmsim::scene {
namespace {

using support::DiagnosticKind;
using support::Diagnostics;

std::optional<types::NamedUnit> meaning_of(const syntax::UnitExpr& unit, Diagnostics& diagnostics) {
  types::NamedUnit product;
  for (const syntax::UnitFactor& factor : unit.factors) {
    const auto named = types::named_unit(factor.name.text);
    const auto power = named ? types::power(named->unit, factor.numerator, factor.denominator)
                             : std::optional<types::Unit>{};
    if (!power) {
      diagnostics.report({.kind = DiagnosticKind::UnknownUnit,
                          .message = fmt::format("no unit named `{}`", factor.name.text),
                          .place = factor.name.span,
                          .help = support::did_you_mean(factor.name.text, types::unit_names())});
      return std::nullopt;
    }
    product.unit = product.unit * *power;
    product.scale *=
        std::pow(named->scale, static_cast<double>(factor.numerator) / factor.denominator);
  }
  return product;
}

std::optional<types::NamedUnit> read_unit(MappedText text, support::SourceMap& sources,
                                          Diagnostics& diagnostics) {
  Diagnostics found;
  std::optional<types::NamedUnit> unit;
  const auto parsed = syntax::parse_unit(sources, text.add_to(sources, "a unit"), found);
  if (parsed && !found.has_errors()) unit = meaning_of(*parsed, found);
  text.report(found, diagnostics);
  return unit;
}

/// The place of the unit within the scalar, the whole of it where the bytes read otherwise.
support::Span unit_place(const YamlNode& node, const NumberAndUnit& parts) {
  if (!node.exact || node.span.end - node.span.begin != node.text.size()) return node.span;
  return {node.span.file, node.span.begin + static_cast<std::uint32_t>(parts.unit_begin),
          node.span.end};
}

std::optional<double> read_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec != std::errc{} || read.ptr != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

}  // namespace

types::Unit schema_unit(std::string_view text) {
  if (text.empty()) return {};
  support::SourceMap sources;
  Diagnostics diagnostics;
  const auto file = sources.add("schema", std::string(text));
  const auto unit =
      read_unit(MappedText::of_span(sources, {file, 0, static_cast<std::uint32_t>(text.size())}),
                sources, diagnostics);
  GMSIM_CHECK(unit.has_value(), "a unit of the scene schema is not understood");
  return unit->unit;
}

std::optional<Quantity> read_quantity(const YamlNode& node, const types::MaybeUnit& wanted,
                                      support::SourceMap& sources, Diagnostics& diagnostics) {
  const auto parts = node.is_scalar() ? split_quantity(node.text) : std::optional<NumberAndUnit>{};
  if (!parts) {
    diagnostics.report({.kind = DiagnosticKind::WrongForm,
                        .message = "a number is needed, this is " + describe(node),
                        .place = node.span});
    return std::nullopt;
  }
  Quantity quantity;
  if (const auto value = read_number(parts->number)) {
    quantity.value = *value;
  } else {
    diagnostics.report({.kind = DiagnosticKind::BadNumber,
                        .message = "this number is out of range",
                        .place = node.span});
    return std::nullopt;
  }
  if (parts->unit.empty()) return quantity;
  const support::Span place = unit_place(node, *parts);
  const std::string written(parts->unit);
  YamlNode unit_node = YamlNode::scalar(written, place);
  unit_node.exact = sources.text(place) == written;
  const auto unit = read_unit(unit_node.exact ? MappedText::of_span(sources, place)
                                              : MappedText::of_value(sources, unit_node),
                              sources, diagnostics);
  if (!unit) return std::nullopt;
  if (wanted && !(*wanted == unit->unit)) {
    diagnostics.report({.kind = DiagnosticKind::UnitMismatch,
                        .message = wanted->dimensionless()
                                       ? "a number without unit is needed here"
                                       : fmt::format("this is in [{}], a value in [{}] is needed",
                                                     written, types::to_string(*wanted)),
                        .place = place});
    return std::nullopt;
  }
  if (wanted && wanted->dimensionless()) {  // 40 deg where degrees are meant, say
    diagnostics.report({.kind = DiagnosticKind::UnitMismatch,
                        .message = "a number without unit is needed here",
                        .place = place});
    return std::nullopt;
  }
  quantity.unit = unit->unit;
  quantity.scale = unit->scale;
  quantity.value *= unit->scale;
  return quantity;
}

}  // namespace gmsim::scene
