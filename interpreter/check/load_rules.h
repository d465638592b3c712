// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "check/check.h"
#include "support/diagnostic.h"
#include "support/source_map.h"
#include "syntax/ast.h"

namespace gmsim::check {

/// What is known about a parsed file besides its tree.
struct LoadedFile {
  support::FileId file{};
  bool library = false;
  bool basics = false;                ///< particles.rule: its embeddings concern every rule
  std::vector<std::size_t> imports = {};  ///< positions of the files it imports itself
};

/// The parsed files of a run in the order in which items are declared: the library's first, then
/// each user file after what it imports. `files` and `info` run in parallel.
struct LoadedRules {
  std::vector<syntax::RuleFile> files;
  std::vector<LoadedFile> info;
  bool broken = false;  ///< some text did not parse, so names may be missing
};

/// Reads and parses the library that `options` asks for, then `files` from disk and `texts`, each
/// with its imports. A given file that lies in a folder `stdlib-rules` under the name of a library
/// file takes that file's place.
[[nodiscard]] LoadedRules load_rules(const std::vector<std::filesystem::path>& files,
                                     const std::vector<support::FileId>& texts,
                                     const LibraryOptions& options, support::SourceMap& sources,
                                     support::Diagnostics& diagnostics);

}  // namespace gmsim::check
