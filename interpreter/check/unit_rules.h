// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "check/make_expr.h"
#include "types/builtin.h"
#include "types/unit.h"

/// Units of expressions. They are gradual: a quantity whose unit is not known agrees with every
/// unit. Bare numbers are dimensionless in products and take the other side's unit elsewhere.
namespace gmsim::check {

/// An expression made of bare numbers only: its unit is free.
[[nodiscard]] bool adopts_unit(const types::Expr& expr);
/// Gives such an expression a unit; its numbers are multiples of `scale` SI units.
[[nodiscard]] ExprPtr adopt(const ExprPtr& expr, const types::MaybeUnit& unit, double scale);

/// The unit that counts in a product: bare numbers are dimensionless.
[[nodiscard]] types::MaybeUnit factor_unit(const types::Expr& expr);
[[nodiscard]] types::MaybeUnit product_unit(const types::Expr& a, const types::Expr& b);
[[nodiscard]] types::MaybeUnit quotient_unit(const types::Expr& a, const types::Expr& b);
/// base^exponent; `valid` is false when a known unit has no such power.
struct PowerUnit {
  types::MaybeUnit unit;
  bool valid = true;
};
[[nodiscard]] PowerUnit power_unit(const types::Expr& base, double exponent);

/// Whether two units are known and differ.
[[nodiscard]] bool disagree(const types::MaybeUnit& a, const types::MaybeUnit& b);

/// "[N]" or "no unit" for messages.
[[nodiscard]] std::string unit_text(const types::MaybeUnit& unit);
/// "vec3 [m/s]"
[[nodiscard]] std::string type_text(const ValueType& type, const types::MaybeUnit& unit);

}  // namespace gmsim::check
