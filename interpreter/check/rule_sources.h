// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "check/check.h"

namespace gmsim::check {

/// A text of the standard library before parsing.
struct LibraryText {
  std::string path;  ///< below the library's folder, with `/`
  std::string name;  ///< as shown in messages
  std::string text;
};

/// All files of the library, sorted by path: packed ones, or those of `options.stdlib_folder`.
[[nodiscard]] std::vector<LibraryText> library_texts(const LibraryOptions& options);

/// Whether the file "tear/x.rule" belongs to one of `modules` ("tear", "tear/x", "x"); particles and
/// patterns belong to every choice, and an empty choice means all.
[[nodiscard]] bool in_modules(std::string_view path, const std::vector<std::string>& modules);
/// Whether a file belongs to one module by name.
[[nodiscard]] bool belongs_to(std::string_view path, const std::string& module);
/// What can be asked for in `modules`, for suggestions.
[[nodiscard]] std::vector<std::string> module_names(const std::vector<LibraryText>& library);

/// Whole contents of a regular file; empty when it cannot be read.
[[nodiscard]] std::optional<std::string> read_text(const std::filesystem::path& path);
/// The same path for the same file, however it was written.
[[nodiscard]] std::string file_identity(const std::filesystem::path& path);
/// Names of the rule files in a folder, for suggestions.
[[nodiscard]] std::vector<std::string> rule_files_in(const std::filesystem::path& folder);

}  // namespace gmsim::check
