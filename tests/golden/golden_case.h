// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gmsim::golden {

/// One file of tests/golden/AREA/ that is run: NAME.rule, NAME.yaml or NAME.cmd.
struct Case {
  std::filesystem::path file;  // relative to the repository root
  [[nodiscard]] std::string name() const { return file.stem().string(); }
  /// Cases called fail_… end with an exit code other than 0, all others with 0.
  [[nodiscard]] bool should_fail() const { return name().starts_with("fail_"); }
  [[nodiscard]] std::filesystem::path expected_out() const;
  [[nodiscard]] std::filesystem::path expected_err() const;
};

/// The cases in root/AREA/, sorted. Folders below an area hold files that cases use. An empty
/// `filters` takes all; a filter is an area ("check") or one case ("check/fail_x").
[[nodiscard]] std::vector<Case> find_cases(const std::filesystem::path& root,
                                           const std::vector<std::string>& filters);

/// Expectations in root/AREA/ that belong to no case: left behind by a renaming.
[[nodiscard]] std::vector<std::filesystem::path> find_orphans(const std::filesystem::path& root);

/// Splits a line at blanks; "…" and '…' keep blanks and each other.
[[nodiscard]] std::vector<std::string> split_arguments(std::string_view line);

/// The command lines of a case: the lines of a .cmd file but for blank ones and # comments, or the
/// one in the first line of a rule (`// args: …`) or YAML file (`# args: …`), else `check %s`.
/// %s is the case's file, %d its folder, %t a folder for output.
[[nodiscard]] std::vector<std::vector<std::string>> command_lines(
    const Case& which, std::string_view text, const std::filesystem::path& scratch);

}  // namespace gmsim::golden
