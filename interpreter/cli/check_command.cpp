// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <ostream>
#include <string>

#include "cli/commands.h"
#include "cli/run_cli.h"
#include "scene/scene.h"
#include "syntax/parse.h"

namespace gmsim::cli {
namespace {

/// Warnings alone still leave the files accepted.
void report_accepted(Session& session, const std::vector<std::string>& asked,
                     const check::CheckedRules& rules) {
  std::size_t items = 0;
  for (const syntax::RuleFile& file : rules.files()) {
    const std::string& name = session.sources.name(file.file);
    if (std::find(asked.begin(), asked.end(), name) != asked.end()) items += file.items.size();
  }
  session.out << fmt::format("{} file{} checked, {} item{}: no errors\n", asked.size(),
                             asked.size() == 1 ? "" : "s", items, items == 1 ? "" : "s");
}

bool is_scene(const std::string& file) {
  return file.ends_with(".yaml") || file.ends_with(".yml");
}

/// Loads a scene up to its first state, which finds what only the built mesh can show.
void check_scene(Session& session, const std::string& file) {
  scene::SceneOptions options;
  options.library.stdlib_folder = session.options.stdlib_folder;
  const auto scene = scene::load_scene(file, options, session.sources, session.diagnostics);
  if (!scene) return;
  std::size_t points = 0, cells = 0;
  for (const scene::BodySummary& body : scene->bodies) {
    points += body.vertices.size();
    cells += body.cells;
  }
  session.out << fmt::format("{}: {}D, {} point{}, {} cell{}: no errors\n", file,
                             scene->program.dimension, points, points == 1 ? "" : "s", cells,
                             cells == 1 ? "" : "s");
}

}  // namespace

int run_check(Session& session) {
  std::vector<std::string> rule_files;
  for (const std::string& file : session.options.files) {
    if (is_scene(file)) check_scene(session, file);
    else rule_files.push_back(file);
  }
  if (rule_files.empty()) return session.finish();
  const check::CheckedRules rules = session.check_rules(rule_files);
  const int code = session.finish();
  if (code == kDone) report_accepted(session, rule_files, rules);
  return code;
}

}  // namespace gmsim::cli
