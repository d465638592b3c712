// SPDX-License-Identifier: MIT
#include "check/load_rules.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "check/rule_sources.h"
#include "support/suggest.h"
#include "syntax/parse.h"

namespace gmsim::check {
namespace fs = std::filesystem;
using support::Diagnostic;
using support::DiagnosticKind;
namespace {

/// Follows imports depth first, so that a file comes after what it imports.
class Loader {
 public:
  Loader(const LibraryOptions& options, support::SourceMap& sources,
         support::Diagnostics& diagnostics)
      : options_(options), sources_(sources), diagnostics_(diagnostics),
        library_(library_texts(options)) {}

  LoadedRules run(const std::vector<fs::path>& files, const std::vector<support::FileId>& texts) {
    std::vector<fs::path> own;
    for (const fs::path& file : files)
      if (!replace_library_file(file)) own.push_back(file);
    load_library();
    for (const fs::path& file : own) load_user_file(file);
    for (const support::FileId text : texts) load_text(text);
    return std::move(result_);
  }

 private:
  /// Being read (a position on the stack of imports), or read (a position in the result).
  struct Progress {
    bool done = false;
    std::size_t position = 0;
  };

  bool replace_library_file(const fs::path& file) {
    const std::string whole = file_identity(file);
    for (LibraryText& text : library_) {
      if (!whole.ends_with("stdlib-rules/" + text.path)) continue;
      std::optional<std::string> content = read_text(file);
      if (!content) return false;
      text.name = file.generic_string();
      text.text = std::move(*content);
      wanted_.push_back(text.path);
      return true;
    }
    return false;
  }

  void load_library() {
    const std::vector<std::string> names = module_names(library_);
    for (const std::string& module : options_.modules) {
      if (std::ranges::any_of(
              library_, [&](const LibraryText& text) { return belongs_to(text.path, module); }))
        continue;
      diagnostics_.report({.kind = DiagnosticKind::ImportNotFound,
                           .message = "the library has no module `" + module + "`",
                           .help = support::did_you_mean(module, names)});
    }
    for (const LibraryText& text : library_)
      if (in_modules(text.path, options_.modules) || std::ranges::count(wanted_, text.path) > 0)
        load_library_text(text);
  }

  std::optional<std::size_t> load_library_text(const LibraryText& text) {
    if (auto known = started("library:" + text.path)) return known;
    const support::FileId file = sources_.add(text.name, text.text);
    return load(file, "library:" + text.path, true, text.path);
  }

  void load_user_file(const fs::path& path) {
    if (started(file_identity(path))) return;
    std::optional<std::string> text = read_text(path);
    if (!text) {
      diagnostics_.report({.kind = DiagnosticKind::FileError,
                           .message = "cannot read `" + path.generic_string() + "`",
                           .help = support::did_you_mean(path.filename().string(),
                                                         rule_files_in(path.parent_path()))});
      return;
    }
    load(sources_.add(path.generic_string(), std::move(*text)), file_identity(path), false, {});
  }

  void load_text(support::FileId file) {
    const std::string identity = file_identity(sources_.name(file));
    // A text that is not on disk has no identity but itself.
    load(file, fs::exists(sources_.name(file)) ? identity : "text:" + std::to_string(texts_++),
         false, {});
  }

  std::optional<std::size_t> started(const std::string& identity) const {
    const auto found = progress_.find(identity);
    if (found == progress_.end() || !found->second.done) return std::nullopt;
    return found->second.position;
  }

  std::size_t load(support::FileId file, const std::string& identity, bool library,
                   const std::string& library_path) {
    progress_[identity] = {};
    stack_.push_back(file);
    const std::size_t errors = diagnostics_.error_count();
    syntax::RuleFile tree = syntax::parse_rule_file(sources_, file, diagnostics_);
    result_.broken |= diagnostics_.error_count() != errors;
    LoadedFile info{.file = file, .library = library, .basics = library_path == "particles.rule"};
    for (const syntax::Item& item : tree.items)
      if (const auto* import = std::get_if<syntax::ImportItem>(&item.node))
        if (auto position = load_import(*import, file, library, library_path))
          info.imports.push_back(*position);
    stack_.pop_back();
    result_.files.push_back(std::move(tree));
    result_.info.push_back(std::move(info));
    progress_[identity] = {true, result_.files.size() - 1};
    return result_.files.size() - 1;
  }

  std::optional<std::size_t> load_import(const syntax::ImportItem& import, support::FileId importer,
                                         bool library, const std::string& library_path) {
    if (library) {
      const std::string path =
          (fs::path(library_path).parent_path() / import.path).lexically_normal().generic_string();
      for (const LibraryText& text : library_)
        if (text.path == path) {
          if (in_progress(import, "library:" + path)) return std::nullopt;
          return load_library_text(text);
        }
      return not_found(import, library_siblings(library_path));
    }
    const fs::path folder = fs::path(sources_.name(importer)).parent_path();
    const fs::path path = (folder / import.path).lexically_normal();
    const std::string identity = file_identity(path);
    if (in_progress(import, identity)) return std::nullopt;
    if (auto known = started(identity)) return known;
    std::optional<std::string> text = read_text(path);
    if (!text) return not_found(import, rule_files_in(path.parent_path()));
    return load(sources_.add(path.generic_string(), std::move(*text)), identity, false, {});
  }

  bool in_progress(const syntax::ImportItem& import, const std::string& identity) {
    const auto found = progress_.find(identity);
    if (found == progress_.end() || found->second.done) return false;
    const std::string& importer = sources_.name(stack_.back());
    diagnostics_.report({.kind = DiagnosticKind::ImportCycle,
                         .message = stack_.size() > 1 && !same_file(identity, importer)
                                        ? "`" + import.path + "` imports this file in turn"
                                        : "a file cannot import itself",
                         .place = import.path_span,
                         .help = "move what both need into a third file"});
    result_.broken = true;
    return true;
  }

  static bool same_file(const std::string& identity, const std::string& name) {
    return identity == file_identity(name);
  }

  std::optional<std::size_t> not_found(const syntax::ImportItem& import,
                                       const std::vector<std::string>& siblings) {
    diagnostics_.report(
        {.kind = DiagnosticKind::ImportNotFound,
         .message = "cannot read `" + import.path + "`",
         .place = import.path_span,
         .help = support::did_you_mean(fs::path(import.path).filename().string(), siblings)});
    result_.broken = true;
    return std::nullopt;
  }

  std::vector<std::string> library_siblings(const std::string& library_path) const {
    std::vector<std::string> names;
    const fs::path folder = fs::path(library_path).parent_path();
    for (const LibraryText& text : library_)
      if (fs::path(text.path).parent_path() == folder)
        names.push_back(fs::path(text.path).filename().string());
    return names;
  }

  const LibraryOptions& options_;
  support::SourceMap& sources_;
  support::Diagnostics& diagnostics_;
  std::vector<LibraryText> library_;
  std::vector<std::string> wanted_;  // library files given by the user
  std::map<std::string, Progress> progress_;
  std::vector<support::FileId> stack_;
  std::size_t texts_ = 0;
  LoadedRules result_;
};

}  // namespace

LoadedRules load_rules(const std::vector<fs::path>& files,
                       const std::vector<support::FileId>& texts, const LibraryOptions& options,
                       support::SourceMap& sources, support::Diagnostics& diagnostics) {
  return Loader(options, sources, diagnostics).run(files, texts);
}

}  // namespace gmsim::check
