// SPDX-License-Identifier: MIT
#include "syntax/ast_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>

namespace gmsim::syntax {
namespace {

template <class List, class Text>
std::string joined(const List& list, std::string_view separator, Text text) {
  std::string all;
  for (const auto& element : list) {
    if (&element != &list.front()) all += separator;
    all += text(element);
  }
  return all;
}

std::string to_text(const OrbitEntry& entry) {
  switch (entry.kind) {
    case OrbitEntry::Kind::Blank:
      return "_";
    case OrbitEntry::Kind::Single:
      return to_text(entry.first);
    case OrbitEntry::Kind::Range:
      return to_text(entry.first) + ".." + to_text(entry.last);
  }
  return {};
}

std::string factor_text(const UnitFactor& factor, int numerator) {
  if (factor.denominator != 1)
    return fmt::format("{}^({}/{})", factor.name.text, numerator, factor.denominator);
  return numerator == 1 ? factor.name.text : fmt::format("{}^{}", factor.name.text, numerator);
}

}  // namespace

std::string to_text(const LinkDimension& dimension) {
  if (!dimension.from_top) return std::to_string(dimension.value);
  return dimension.value == 0 ? "n" : fmt::format("n-{}", dimension.value);
}

std::string to_text(const OrbitExpr& orbit) {
  if (orbit.name) return orbit.name->text;
  const auto entry_text = [](const OrbitEntry& entry) { return to_text(entry); };
  return fmt::format("<{}>", joined(orbit.entries, ",", entry_text));
}

std::string to_text(const UnitExpr& unit) {
  if (unit.factors.empty()) return "[1]";
  const auto is_above = [](const UnitFactor& factor) { return factor.numerator >= 0; };
  const auto as_is = [](const UnitFactor& factor) { return factor_text(factor, factor.numerator); };
  const auto below = std::find_if_not(unit.factors.begin(), unit.factors.end(), is_above);
  // Factors keep their order, so a mixed one cannot be written with a fraction bar.
  if (below == unit.factors.end() || std::any_of(below, unit.factors.end(), is_above))
    return fmt::format("[{}]", joined(unit.factors, " ", as_is));
  const std::vector<UnitFactor> above(unit.factors.begin(), below);
  const std::vector<UnitFactor> divisors(below, unit.factors.end());
  const std::string top = above.empty() ? "1" : joined(above, " ", as_is);
  const std::string bottom = joined(divisors, " ", [](const UnitFactor& factor) {
    return factor_text(factor, -factor.numerator);
  });
  return fmt::format(fmt::runtime(divisors.size() > 1 ? "[{}/({})]" : "[{}/{}]"), top, bottom);
}

std::string with_blank(const std::optional<UnitExpr>& unit) {
  return unit ? fmt::format(" {}", to_text(*unit)) : std::string{};
}

std::string to_text(const TypeExpr& type) {
  std::string text = type.name.text;
  for (const std::uint32_t extent : type.extents) text += fmt::format("[{}]", extent);
  return text + with_blank(type.unit);
}

std::string to_text(const NodeMention& mention) {
  return mention.name.text + (mention.label ? to_text(*mention.label) : "");
}

std::string to_text(const Link& link) {
  const auto step_text = [](const LinkDimension& step) { return to_text(step); };
  return fmt::format("-{}-", joined(link.path, ".", step_text));
}

std::string to_text(const PatternStatement& statement) {
  return std::visit(Overloaded{[](const Chain& chain) {
                                 std::string text = to_text(chain.nodes.front());
                                 for (std::size_t i = 0; i < chain.links.size(); ++i)
                                   text += fmt::format(" {} {}", to_text(chain.links[i]),
                                                       to_text(chain.nodes[i + 1]));
                                 return text + ";";
                               },
                               [](const PatternUse& use) {
                                 return fmt::format("{}({});", use.pattern.text,
                                                    to_text(use.arguments));
                               },
                               [](const DimensionStatement& dimension) {
                                 return fmt::format("dimension {};", dimension.dimension);
                               }},
                    statement.node);
}

std::string to_text(const std::vector<Name>& names) {
  return joined(names, ", ", [](const Name& name) { return name.text; });
}

std::string_view to_text(BinaryOp op) {
  // In the order of BinaryOp.
  constexpr std::array<std::string_view, 13> kTexts = {
      "+", "-", "*", "/", "^", "<", "<=", ">", ">=", "==", "!=", "and", "or"};
  return kTexts.at(static_cast<std::size_t>(op));
}

std::string_view to_text(SideKind side) {
  constexpr std::array<std::string_view, 3> kTexts = {"left", "right", "match"};
  return kTexts.at(static_cast<std::size_t>(side));
}

std::string quoted(std::string_view text) {
  std::string all = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') all += '\\';
    all += c;
  }
  return all + "\"";
}

}  // namespace gmsim::syntax
