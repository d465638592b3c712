// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "types/value_type.h"

namespace gmsim::types {

/// Every builtin function; the rows live in builtins.def. Operators are not builtins.
enum class Builtin {
#define BUILTIN(id, name, signatures, units, doc) id,
#include "types/builtins.def"
#undef BUILTIN
};

/// How the unit of a result follows from those of the arguments.
enum class UnitRule {
  None,           ///< arguments and result without unit (exp, log)
  Same,           ///< all arguments and the result share one unit (min, max, abs, clamp)
  First,          ///< the unit of the first argument (norm, trace, transpose)
  Product,        ///< product of the units of all arguments (dot, cross)
  Dimensionless,  ///< any argument, dimensionless result (normalize, sign, polar_rotation)
  Ratio,          ///< all arguments share one unit, dimensionless result (atan2)
  Root,           ///< square root of the first (sqrt)
  Inverse,        ///< reciprocal of the first (inverse)
  Cube,           ///< det of a 3x3 (unit^3); square for a 2x2
  Angle           ///< dimensionless argument, dimensionless result (sin, acos)
};

/// One overload: parameter types and result type.
struct Signature {
  std::vector<ValueType> parameters;
  ValueType result;
};

struct BuiltinInfo {
  Builtin id;
  std::string_view name;
  std::vector<Signature> signatures;
  UnitRule units;
  std::string_view doc;
};

[[nodiscard]] const std::vector<BuiltinInfo>& builtins();
[[nodiscard]] const BuiltinInfo& info(Builtin id);
[[nodiscard]] std::optional<Builtin> builtin(std::string_view name);

}  // namespace gmsim::types
