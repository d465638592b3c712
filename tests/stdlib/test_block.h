// SPDX-License-Identifier: MIT
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <string>
#include <vector>

namespace gmsim::test {

/// One entry of the `Test:` part of a doc comment in a rule file, a YAML map:
///
///     about:       what it shows
///     mesh:        a mesh as on the command line, or { dimension, points, cells }
///     density:     of the mesh; 1 unless given
///     rules:       items that the block needs, beside the library
///     set:         { embedding: expression }, evaluated at every orbit of the embedding
///     apply:       a rule or operation; or a list of { apply, to, where, params, times, at }
///     to, where, params, times, at:   of a single `apply`, as in `gmsim apply`
///     not_applied: true when nothing may have been applied
///     matches:     { interaction: number of matches }
///     interaction: one to evaluate, with `params`, `where` and `move` (positions after rest)
///     criteria:    { criterion of that interaction: values at its matches }
///     expect:      counts (applied, darts, vertices, edges, faces, volumes, components, matches),
///                  energy, force: { point: vector }, finite, or { expression: value }
struct TestBlock {
  std::filesystem::path file;
  int line = 0;
  YAML::Node yaml;

  /// "springs/stretch.rule:20: twice its length"
  [[nodiscard]] std::string title() const;
};

/// The blocks of one rule file, or of all below a folder, sorted by path. A block that is no YAML
/// throws YAML::Exception.
[[nodiscard]] std::vector<TestBlock> blocks_of_file(const std::filesystem::path& file);
[[nodiscard]] std::vector<TestBlock> blocks_of_folder(const std::filesystem::path& folder);

}  // namespace gmsim::test
