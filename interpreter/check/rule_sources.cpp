// SPDX-License-Identifier: MIT
#include "check/rule_sources.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <system_error>

#include "check/packed_rules.h"

namespace gmsim::check {
namespace fs = std::filesystem;
namespace {

std::vector<LibraryText> texts_on_disk(const fs::path& folder) {
  std::vector<LibraryText> texts;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error)) {
    if (at->path().extension() != ".rule") continue;
    if (auto text = read_text(at->path()))
      texts.push_back({at->path().lexically_relative(folder).generic_string(),
                       at->path().generic_string(), std::move(*text)});
  }
  std::ranges::sort(texts, {}, &LibraryText::path);
  return texts;
}

std::string without_extension(std::string_view path) {
  constexpr std::string_view extension = ".rule";
  if (path.ends_with(extension)) path.remove_suffix(extension.size());
  return std::string(path);
}

std::string folder_of(std::string_view path) {
  const std::size_t slash = path.find('/');
  return slash == std::string_view::npos ? std::string() : std::string(path.substr(0, slash));
}

std::string stem_of(std::string_view path) {
  const std::string module = without_extension(path);
  const std::size_t slash = module.rfind('/');
  return slash == std::string::npos ? module : module.substr(slash + 1);
}

}  // namespace

std::vector<LibraryText> library_texts(const LibraryOptions& options) {
  if (!options.with_stdlib) return {};
  if (!options.stdlib_folder.empty()) return texts_on_disk(options.stdlib_folder);
  std::vector<LibraryText> texts;
  for (const PackedRule& rule : packed_rules())
    texts.push_back({std::string(rule.path), "stdlib-rules/" + std::string(rule.path),
                     std::string(rule.text)});
  return texts;
}

bool belongs_to(std::string_view path, const std::string& module) {
  return module == folder_of(path) || module == without_extension(path) || module == stem_of(path);
}

bool in_modules(std::string_view path, const std::vector<std::string>& modules) {
  if (modules.empty() || path == "particles.rule" || path == "patterns.rule") return true;
  return std::ranges::any_of(
      modules, [&](const std::string& module) { return belongs_to(path, module); });
}

std::vector<std::string> module_names(const std::vector<LibraryText>& library) {
  std::set<std::string> names;
  for (const LibraryText& text : library) {
    names.insert(stem_of(text.path));
    if (const std::string folder = folder_of(text.path); !folder.empty()) names.insert(folder);
  }
  return {names.begin(), names.end()};
}

std::optional<std::string> read_text(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return std::nullopt;
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(in), {});
}

std::string file_identity(const fs::path& path) {
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(path, error);
  return (error ? path.lexically_normal() : whole).generic_string();
}

std::vector<std::string> rule_files_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(folder.empty() ? fs::path(".") : folder, error), end;
       !error && at != end; at.increment(error))
    if (at->path().extension() == ".rule") names.push_back(at->path().filename().string());
  std::ranges::sort(names);
  return names;
}

}  // namespace gmsim::check
