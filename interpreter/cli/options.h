// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gmsim::cli {

/// One parsed command line. Fields beyond `command` are those of the command named.
struct Options {
  enum class Command { None, Check, List, Apply, Dump, Fuzz } command = Command::None;

  // every command
  std::filesystem::path stdlib_folder;
  std::vector<std::string> dumps;
  std::vector<std::string> files;  ///< rule files (and scenes, for check)
  int dimension = 0;               ///< 0: decided by the mesh, or all

  // list
  std::string what;
  bool markdown = false;

  // apply, fuzz
  std::string rule;
  std::string mesh;
  std::string to;
  std::string where;
  std::vector<std::uint32_t> at;  ///< hook darts
  std::vector<std::string> parameters;  ///< name=value
  std::uint32_t times = 1;
  std::filesystem::path output;
  double density = 1.0;
  bool naive_matcher = false;
  bool validate = false;
  bool profile = false;

  // fuzz
  std::uint64_t seed = 0;
  bool has_seed = false;
  std::uint32_t trials = 1000;
};

/// The result of reading a command line: options, or the exit code of a request that is answered
/// already (`-h`, `--version`) or refused with a message.
struct ParsedOptions {
  Options options;
  std::optional<int> exit_code;
};
[[nodiscard]] ParsedOptions parse_options(std::span<const std::string> arguments,
                                          std::ostream& out, std::ostream& err);

}  // namespace gmsim::cli
