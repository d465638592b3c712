// SPDX-License-Identifier: MIT
#include "check/check.h"

#include <utility>

#include "check/checking.h"
#include "check/dimension_checker.h"
#include "check/load_rules.h"
#include "check/merge_reports.h"

namespace gmsim::check {
namespace {

/// Nodes of checked expressions that one dimension may have: a library of a hundred rules needs some
/// ten thousand, and this many take about a second.
constexpr std::int64_t kNodeBudget = 2'000'000;

}  // namespace

/// From texts to checked rules: read, collect the items, check them in each dimension
/// (DimensionChecker::passes), report.
class RuleChecker {
 public:
  /// `own`: there are rules beside the library's.
  static CheckedRules run(LoadedRules loaded, bool own, const LibraryOptions& options,
                          const support::SourceMap& sources, support::Diagnostics& diagnostics) {
    CheckedRules rules;
    rules.checking_ = std::make_shared<Checking>(loaded, diagnostics);
    Checking& checking = *rules.checking_;
    for (int d = 1; d <= 3; ++d) {
      auto library = std::make_unique<RuleLibrary>();
      library->dimension = d;
      Environment& env = checking.environments[static_cast<std::size_t>(d - 1)];
      env.dimension = d;
      env.items = &checking.items;
      env.library = library.get();
      env.states.resize(checking.items.entries().size());
      env.names_missing = loaded.broken;
      env.keep_rejected = options.keep_rejected;
      env.node_budget = kNodeBudget;
      if (own || is_wanted(d, options)) DimensionChecker(env, loaded, sources).run();
      list_definitions(env);
      rules.libraries_[static_cast<std::size_t>(d - 1)] = std::move(library);
    }
    rules.absent_ = merge_reports(checking.items, checking.environments, diagnostics);
    rules.files_ = std::move(loaded.files);
    return rules;
  }

  static Checking& checking(const CheckedRules& rules) { return *rules.checking_; }

 private:
  static bool is_wanted(int dimension, const LibraryOptions& options) {
    if (!options.stdlib_folder.empty()) return true;  // not known to be right
    return options.dimension == 0 || options.dimension == dimension;
  }

  /// Functions and patterns for lists: their bodies are gone from checked rules.
  static void list_definitions(Environment& env) {
    for (ItemIndex i = 0; i < env.states.size(); ++i) {
      if (env.states[i].status != ItemStatus::Present || !env.items->active(i, env.dimension))
        continue;
      const ItemEntry& entry = (*env.items)[i];
      const auto* function = std::get_if<syntax::FunctionItem>(&entry.item->node);
      const auto* pattern = std::get_if<syntax::PatternItem>(&entry.item->node);
      if (!function && !pattern) continue;
      std::string signature = entry.name->text + "(";
      const auto& parameters = function ? function->parameters : pattern->parameters;
      for (std::size_t k = 0; k < parameters.size(); ++k)
        signature += (k > 0 ? ", " : "") + parameters[k].text;
      auto& list = function ? env.library->functions : env.library->patterns;
      list.push_back({entry.name->text, signature + ")", entry.item->doc, entry.name->span});
    }
  }
};

std::string CheckedRules::why_absent(const std::string& item, int dimension) const {
  for (const auto& [name, reasons] : absent_)
    if (name == item && !reasons.at(static_cast<std::size_t>(dimension - 1)).empty())
      return reasons.at(static_cast<std::size_t>(dimension - 1));
  return {};
}

CheckedRules check_rules(const std::vector<std::filesystem::path>& files,
                         const LibraryOptions& options, support::SourceMap& sources,
                         support::Diagnostics& diagnostics) {
  return RuleChecker::run(load_rules(files, {}, options, sources, diagnostics), !files.empty(),
                          options, sources, diagnostics);
}

CheckedRules check_texts(const std::vector<support::FileId>& texts, const LibraryOptions& options,
                         support::SourceMap& sources, support::Diagnostics& diagnostics) {
  return RuleChecker::run(load_rules({}, texts, options, sources, diagnostics), !texts.empty(),
                          options, sources, diagnostics);
}

Checking& checking_of(const CheckedRules& rules) { return RuleChecker::checking(rules); }

}  // namespace gmsim::check
