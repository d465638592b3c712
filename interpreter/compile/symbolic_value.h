// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "compile/ir.h"
#include "types/orbit_type.h"

namespace gmsim::compile {

using types::DartId;

/// A dart and how it was reached: a step of a WalkTrace, or kNoWalk when it came out of a
/// collection whose order depends on dart numbers.
inline constexpr std::uint32_t kNoWalk = 0xffffffffu;
struct DartRef {
  DartId dart = types::kNoDart;
  std::uint32_t walk = kNoWalk;
};

/// What an expression is at one match. Which member counts follows from its type.
struct SymbolicValue {
  /// A bool, int or real that all matches of the shape share: `number` holds it.
  bool known = false;
  double number = 0;
  double upper = 0;  ///< a range is number <= i < upper
  DartRef dart;
  std::shared_ptr<const std::vector<DartRef>> darts;
  std::shared_ptr<const std::vector<std::uint32_t>> forces;  ///< numbers into MatchRoles::atomic
  /// Numbers, taken apart as value_parts says; a Bool is a mask, an eigenpair value and vector.
  /// Empty for known numbers, and always while no graph is built.
  std::vector<ir::NodeId> parts;

  static SymbolicValue of(double number) {
    SymbolicValue value;
    value.known = true;
    value.number = number;
    return value;
  }
  static SymbolicValue of(DartRef dart) {
    SymbolicValue value;
    value.dart = dart;
    return value;
  }
};

}  // namespace gmsim::compile
