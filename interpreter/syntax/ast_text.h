// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "syntax/ast.h"

/// The parts of a tree that are shown in one line, as they are written in rule files.
namespace gmsim::syntax {

/// `std::visit` over a list of lambdas; a shape without one does not compile.
template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

[[nodiscard]] std::string to_text(const LinkDimension& dimension);
[[nodiscard]] std::string to_text(const OrbitExpr& orbit);
[[nodiscard]] std::string to_text(const UnitExpr& unit);
/// The unit with a blank before it, or nothing.
[[nodiscard]] std::string with_blank(const std::optional<UnitExpr>& unit);
[[nodiscard]] std::string to_text(const TypeExpr& type);
[[nodiscard]] std::string to_text(const NodeMention& mention);
[[nodiscard]] std::string to_text(const Link& link);
/// A pattern statement with its `;`.
[[nodiscard]] std::string to_text(const PatternStatement& statement);
/// `a, b, c`.
[[nodiscard]] std::string to_text(const std::vector<Name>& names);
[[nodiscard]] std::string_view to_text(BinaryOp op);
[[nodiscard]] std::string_view to_text(SideKind side);
/// The text in quotation marks, with the escapes of string literals.
[[nodiscard]] std::string quoted(std::string_view text);

}  // namespace gmsim::syntax
