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

/// Of the commands that load a scene: run, verify, explain, study.
struct RunOptions {
  std::filesystem::path scene;
  std::vector<std::string> overrides;  ///< PATH=VALUE
  std::filesystem::path output;        ///< empty: what the scene says, else its name
  bool no_output = false;
  bool force = false;
  bool json = false;
  bool tree_kernel = false;
  bool explain_tear = false;
  unsigned threads = 1;
  std::optional<double> max_wall;      ///< s
  std::vector<std::string> traces;     ///< PHASE or PHASE:RULE
};

/// Of `study`, beside the scene.
struct StudyOptions {
  std::vector<std::string> methods;
  std::vector<double> steps;                ///< s, of methods with a fixed step
  std::vector<double> tolerances = {1e-4, 1e-6, 1e-8};  ///< of those that choose their steps
  std::optional<double> reference_step;     ///< s
  std::string reference_method = "rk4";
  std::uint32_t repetitions = 5;
  std::filesystem::path folder;
};

/// Of the commands that read a file which a run left: info, export, recover, snapshot.
struct FileOptions {
  std::filesystem::path file;
  std::filesystem::path output;  ///< a file, or the folder of `export`
  std::string format = "pvd";
  std::int64_t first = 0, last = -1, every = 1;
  bool json = false;
  bool show_scene = false;
  bool show_rules = false;
  bool show_events = false;
  std::int64_t frames = 150;     ///< of a page, at most
  std::string field, title;
  bool force = false;
};

/// One parsed command line. Fields beyond `command` are those of the command named.
struct Options {
  enum class Command {
    None,
    Check,
    List,
    Apply,
    Dump,
    Fuzz,
    Run,
    Verify,
    Explain,
    Study,
    Info,
    Export,
    Recover,
    Snapshot,
    View
  } command = Command::None;

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
  bool force = false;  ///< try a rule that the checker rejects

  RunOptions run;
  StudyOptions study;
  FileOptions file;
  std::string command_line;  ///< as it was typed, for the record in the output
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
