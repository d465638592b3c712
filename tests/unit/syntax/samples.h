// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

namespace gmsim::syntax {

/// A text and its tree. Trees of expressions are in one line, `(label part part)`, with plain
/// names and numbers for themselves; those of items are as `dump_ast` prints them.
struct Sample {
  std::string_view source;
  std::string_view tree;
};

extern const std::vector<Sample> kExpressions;
extern const std::vector<Sample> kItems;

}  // namespace gmsim::syntax
