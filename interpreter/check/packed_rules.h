// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

namespace gmsim::check {

/// A file of the standard library as packed into the program at build.
struct PackedRule {
  std::string_view path;  ///< below stdlib-rules, "tear/separate_elements.rule"
  std::string_view text;
};

/// Sorted by path. Defined in a source that pack_rules.cmake writes at build.
[[nodiscard]] const std::vector<PackedRule>& packed_rules();

}  // namespace gmsim::check
