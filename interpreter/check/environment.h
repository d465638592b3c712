// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "check/checked_rule.h"
#include "check/item_table.h"
#include "support/diagnostic.h"

namespace gmsim::check {

/// How far an item has come in one dimension of the map.
enum class ItemStatus {
  Unchecked,
  InProgress,
  Present,
  Absent,  ///< makes no sense in this dimension
  Failed   ///< reported, or refers to something reported
};

/// What checking an item gave in one dimension.
struct ItemState {
  ItemStatus status = ItemStatus::Unchecked;
  std::optional<support::Diagnostic> absence;  ///< why it is Absent
  support::Diagnostics diagnostics;
};

enum class FamilyIndex : std::uint32_t {};
/// What a name after `.` can mean.
using ValueRef = std::variant<EmbeddingId, InteractionId, FamilyIndex>;

/// Facts about a function, found when its body is checked by itself.
struct FunctionFacts {
  /// For each parameter a place where the body uses it as a dart.
  std::vector<std::optional<Span>> dart_uses;
};

/// Definitions that use definitions, and calls inside of calls, are followed this deep.
inline constexpr int kDeepestDefinition = 64;

/// All that expressions and patterns of one dimension can refer to.
struct Environment {
  int dimension = 2;
  const ItemTable* items = nullptr;
  RuleLibrary* library = nullptr;
  std::vector<ItemState> states;  ///< by ItemIndex
  std::map<std::string, ValueRef> values;
  std::map<ItemIndex, FunctionFacts> functions;
  /// Some text could not be parsed: a name that is not found may stand there.
  bool names_missing = false;
  bool keep_rejected = false;  ///< LibraryOptions::keep_rejected
  /// Nodes of expressions that this run may still make.
  std::int64_t node_budget = 0;
  /// Functions or patterns that are being checked because another one uses them.
  int definition_depth = 0;
};

}  // namespace gmsim::check
