// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "support/diagnostic.h"
#include "syntax/ast_factories.h"
#include "syntax/scanner.h"

namespace gmsim::syntax {

/// A token that the grammar does not allow where it stands.
struct UnexpectedToken {
  support::FileId file;
  std::string_view text;  ///< of the file
  Token found;
  const Token* before = nullptr;      ///< the token before it, if any
  const Token* open_block = nullptr;  ///< the innermost `{` around it, if any
  std::vector<RuleParser::symbol_kind_type> expected;
  ItemKind item = ItemKind::Rule;  ///< what is being read, where statements are expected
};

/// "unexpected name `rihgt`; expected `left`, `right` or `}`", with a guess at what was meant.
[[nodiscard]] support::Diagnostic describe(const UnexpectedToken& unexpected);

}  // namespace gmsim::syntax
