// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "check/rule_sources.h"
#include "compile/compile.h"
#include "scene/build_scene.h"
#include "scene/override.h"
#include "scene/read_run.h"
#include "scene/read_tear.h"
#include "scene/resolved_text.h"
#include "scene/scene.h"
#include "scene/validate.h"
#include "support/suggest.h"

namespace gmsim::scene {
namespace fs = std::filesystem;
namespace {

using support::DiagnosticKind;
using support::Diagnostics;

/// Longer than any scene that a person writes; inline meshes have their place in files.
constexpr std::size_t kLargestText = 64'000'000;

std::optional<support::FileId> read_text(const fs::path& path, support::SourceMap& sources,
                                         Diagnostics& diagnostics) {
  const auto refuse = [&](const std::string& reason) {
    diagnostics.report({.kind = DiagnosticKind::FileError,
                        .message = fmt::format("cannot read `{}`: {}", path.string(), reason)});
    return std::nullopt;
  };
  std::error_code error;
  if (fs::is_directory(path, error)) return refuse("it is a folder");
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream.is_open()) return refuse(std::strerror(errno));
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) return refuse(std::strerror(errno));
  if (text.size() > kLargestText) return refuse("it is too long for a scene");
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  return sources.add(path.string(), std::move(text));
}

/// The parts of loading that come one after another.
class Loader {
 public:
  Loader(const fs::path& path, const SceneOptions& options, support::SourceMap& sources,
         Diagnostics& diagnostics)
      : options_(options),
        sources_(sources),
        diagnostics_(diagnostics),
        scene_(std::make_unique<Scene>()) {
    scene_->path = path;
  }

  std::unique_ptr<Scene> load() {
    if (!read_tree() || !check_rules() || !read_parts()) return nullptr;
    if (options_.build && !build_scene(*scene_, plan_, diagnostics_)) return nullptr;
    return std::move(scene_);
  }

 private:
  /// False when there is nothing to go on with; errors in values do not stop the search for more.
  bool read_tree() {
    const auto file = read_text(scene_->path, sources_, diagnostics_);
    if (!file) return false;
    const auto length = static_cast<std::uint32_t>(sources_.text(*file).size());
    const std::size_t errors = diagnostics_.error_count();
    errors_before_ = errors;
    tree_ = parse_yaml(sources_, {*file, 0, length}, diagnostics_);
    apply_overrides(tree_, options_.overrides, sources_, diagnostics_);
    if (diagnostics_.error_count() > errors) return false;
    validate_scene(tree_, sources_, diagnostics_);
    if (!tree_.is_map()) return false;
    scene_->resolved = resolved_text(tree_);
    read_run(tree_, sources_, diagnostics_, *scene_);
    return true;
  }

  [[nodiscard]] bool good() const { return diagnostics_.error_count() == errors_before_; }

  bool check_rules() {
    std::vector<fs::path> files;
    const std::vector<check::LibraryText> library = check::library_texts(options_.library);
    bool found = true;
    for (const YamlNode& rule : tree_.find("rules")->items) {
      const bool module = std::ranges::any_of(library, [&](const check::LibraryText& text) {
        return check::belongs_to(text.path, rule.text);
      });
      if (module && !rule.text.empty()) continue;
      const fs::path file = scene_->path.parent_path() / rule.text;
      std::error_code error;
      if (fs::is_regular_file(file, error)) {
        files.push_back(file);
        continue;
      }
      found = false;
      report_missing_rules(rule, check::module_names(library));
    }
    const std::size_t errors = diagnostics_.error_count();
    const YamlNode* dimension = tree_.find("dimension");
    check::LibraryOptions options = options_.library;
    if (good() && dimension != nullptr) {
      options.dimension = static_cast<int>(number_of(*dimension, sources_));
    }
    scene_->rules = check::check_rules(files, options, sources_, diagnostics_);
    // messages about names would only repeat what is wrong with the rules
    return found && diagnostics_.error_count() == errors && dimension != nullptr;
  }

  void report_missing_rules(const YamlNode& rule, std::vector<std::string> names) {
    for (const std::string& file : check::rule_files_in(scene_->path.parent_path()))
      names.push_back("./" + file);
    std::string help = support::did_you_mean(rule.text, names);
    if (help.empty()) help = "files are named relative to the scene, as in `./my.rule`";
    diagnostics_.report(
        {.kind = DiagnosticKind::ImportNotFound,
         .message = fmt::format("`{}` is neither a module of the library nor a file", rule.text),
         .place = rule.span,
         .help = std::move(help)});
  }

  bool read_parts() {
    plan_.dimension = static_cast<int>(number_of(*tree_.find("dimension"), sources_));
    scene_->program = compile::compile_program(scene_->rules.in(plan_.dimension));
    ReadContext context(scene_->rules, scene_->program, scene_->path.parent_path(), sources_,
                        diagnostics_);
    read_bodies(tree_, context, plan_);
    read_interactions(tree_, context, plan_);
    read_selections(tree_, context, plan_);
    scene_->model.tears = read_tears(tree_, context);
    scene_->model.rewrites = read_rewrites(tree_, context);
    read_output(tree_, context, *scene_);
    read_expectations(tree_, context, *scene_, plan_);
    require_one_on_split();
    return good();
  }

  /// What stays fixed of a torn vertex is a rule of the whole scene.
  void require_one_on_split() {
    for (std::size_t i = 1; i < plan_.fixes.size(); ++i) {
      if (plan_.fixes[i].on_split == plan_.fixes[0].on_split) continue;
      diagnostics_.report({.kind = DiagnosticKind::Conflict,
                           .message = "`on_split` differs between the entries of `fix`",
                           .place = plan_.fixes[i].vertices.span,
                           .related = {{plan_.fixes[0].vertices.span, "the first one"}},
                           .help = "it is the same for all that is fixed"});
    }
  }

  const SceneOptions& options_;
  support::SourceMap& sources_;
  Diagnostics& diagnostics_;
  std::unique_ptr<Scene> scene_;
  YamlNode tree_;
  ScenePlan plan_;
  std::size_t errors_before_ = 0;
};

}  // namespace

std::unique_ptr<Scene> load_scene(const fs::path& path, const SceneOptions& options,
                                  support::SourceMap& sources, Diagnostics& diagnostics) {
  return Loader(path, options, sources, diagnostics).load();
}

}  // namespace gmsim::scene
