// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>
#include <vector>

namespace gmsim::test {

/// What checking a text gave.
struct CheckOutcome {
  std::set<std::string> error_kinds;
  std::string rendered;  ///< all diagnostics as a user sees them
};

/// A named text of a rule file.
struct NamedText {
  std::string name;
  std::string text;
};

/// Checks rule texts together, with the standard library or by themselves.
[[nodiscard]] CheckOutcome check_rule_texts(const std::vector<NamedText>& texts,
                                            bool with_stdlib = true);
/// Checks an expression as scenes hold them, in one dimension of the map.
[[nodiscard]] CheckOutcome check_scene_expression(const NamedText& text, int dimension);

/// The text of a file.
[[nodiscard]] std::string read_file(const std::string& path);

}  // namespace gmsim::test
