// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "check/item_context.h"

namespace gmsim::check {

/// A rule or operation that `apply` names.
struct ChangeTarget {
  bool operation = false;
  std::uint32_t index = 0;   ///< into RuleLibrary::rules or ::operations
  std::size_t darts = 1;     ///< that it is applied to
  const std::vector<Parameter>* parameters = nullptr;
  Span span;                 ///< of its name where it is declared
};

/// Finds what `apply NAME(…)` names, which must be checked already; empty after a report.
[[nodiscard]] std::optional<ChangeTarget> find_change(ItemContext& context,
                                                      const syntax::Name& name);

}  // namespace gmsim::check
