// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <utility>

#include "check/item_table.h"
#include "support/diagnostic.h"
#include "syntax/ast.h"

namespace gmsim::check {

/// Kind and name of an item; empty for `import` and `dimension`.
[[nodiscard]] std::optional<std::pair<ItemKind, const syntax::Name*>> item_name(
    const syntax::Item& item);

/// A `dimension k;` with its place.
struct DimensionChoice {
  std::optional<int> dimension;
  support::Span span;
};
/// What a file says for all of its items.
[[nodiscard]] DimensionChoice file_dimension(const syntax::RuleFile& file,
                                             support::Diagnostics& diagnostics);
/// What an item says in its body, else what its file says; both must agree.
[[nodiscard]] DimensionChoice item_dimension(const syntax::Item& item,
                                             const DimensionChoice& whole_file,
                                             support::Diagnostics& diagnostics);

/// The statements of an item that has some, else null.
[[nodiscard]] const std::vector<syntax::Statement>* item_body(const syntax::Item& item);

}  // namespace gmsim::check
