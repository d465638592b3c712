// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/named_item.h"
#include "cli/run_cli.h"
#include "compile/compile.h"
#include "engine/operation.h"
#include "engine/rewrite.h"
#include "gmap/random_map.h"
#include "gmap/validate.h"

namespace gmsim::cli {
namespace {

using engine::DartId;
using engine::State;
using gmap::GMap;
using types::index;

/// A map, the hook darts at which the rule is applied, and what the values come from.
struct Trial {
  GMap map;
  std::vector<DartId> hooks;
  std::uint64_t seed = 0;
};

/// What a rule did to one map.
struct Verdict {
  bool applied = false;
  std::vector<std::string> broken;  ///< axioms that no longer hold
  std::string error;                ///< a run-time error: no value, conflicting values …
  [[nodiscard]] bool bad() const { return !broken.empty() || !error.empty(); }
};

/// The map without one dart: it is unsewn from everything and removed.
GMap without(const GMap& map, DartId dart) {
  GMap smaller = map;
  for (int i = 0; i <= map.dimension(); ++i)
    if (!smaller.is_free(i, dart)) smaller.unsew(i, dart);
  smaller.remove_dart(dart);
  return smaller;
}

std::string map_text(const GMap& map) {
  std::string text = "  dart";
  for (int i = 0; i <= map.dimension(); ++i) text += fmt::format("  a{:<4}", i);
  for (std::uint32_t d = 0; d < map.dart_end(); ++d) {
    if (!map.alive(DartId{d})) continue;
    text += fmt::format("\n  {:<4}", d);
    for (int i = 0; i <= map.dimension(); ++i)
      text += fmt::format("  {:<5}", index(map.alpha(i, DartId{d})));
  }
  return text + '\n';
}

/// Looks for a map on which a rule or operation goes wrong, in one dimension of the map.
class Fuzzer {
 public:
  Fuzzer(Session& session, const check::CheckedRules& rules, int dimension)
      : session_(session),
        rules_(rules),
        program_(compile::compile_program(rules.in(dimension))),
        random_(session.options.seed) {
    // What plans say of orbits holds for rules that are accepted.
    if (session.options.force)
      for (compile::Rule& rule : program_.rules) rule.rewrite.orbits.clear();
  }

  /// False when something went wrong or nothing could be tried.
  bool run() {
    const State empty(program_, GMap(program_.dimension));
    item_ = find_named_item(rules_, program_, session_);
    if (!item_ || !read_arguments(*item_, rules_, empty, session_, arguments_)) return false;
    for (std::uint32_t trial = 0; trial < session_.options.trials; ++trial) {
      Trial candidate = make_trial();
      const Verdict verdict = judge(candidate);
      applied_ += verdict.applied;
      if (verdict.broken.empty() && !verdict.error.empty()) {
        ++errors_;
        if (!first_error_) first_error_ = std::make_unique<Trial>(std::move(candidate));
      }
      if (!verdict.broken.empty()) return report_broken(shrink(std::move(candidate), true));
    }
    report_result();
    return errors_ == 0 || !session_.options.force;
  }

 private:
  Trial make_trial() {
    const auto darts = static_cast<std::uint32_t>(1 + random_() % 40);
    Trial trial{gmap::random_map(program_.dimension, darts, random_()), {}, random_()};
    for (std::size_t k = 0; k < item_->hook_count(); ++k)
      trial.hooks.push_back(DartId{static_cast<std::uint32_t>(random_() % darts)});
    return trial;
  }

  /// Every stored value gets a number that depends on its orbit, so that mixed-up values show.
  static void fill(State& state, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    state.use_data();
    for (const types::EmbeddingId id : state.store.embeddings()) {
      gmap::EmbeddingColumn& column = state.store.column(id);
      const gmap::OrbitIndex* rows = state.store.find_index(state.store.schema()[id].orbit);
      std::vector<double> value(column.stride());
      for (gmap::Row row = 0; row < rows->row_end(); ++row) {
        for (double& component : value) component = static_cast<double>(random() % 1000) / 100;
        if (state.store.schema()[id].type.kind == types::ValueKind::Bool)
          for (double& component : value) component = component > 5 ? 1 : 0;
        column.set(row, value);
      }
    }
  }

  Verdict judge(const Trial& trial) {
    State state(program_, trial.map);
    fill(state, trial.seed);
    engine::Rewriter rewriter(state, {.validate = session_.options.force});
    Verdict verdict;
    try {
      const engine::RewriteOutcome outcome =
          item_->operation
              ? engine::OperationRunner(rewriter).run(*item_->operation, trial.hooks[0], arguments_)
              : rewriter.apply(*item_->rule, trial.hooks, arguments_);
      verdict.applied = outcome.applied();
      if (outcome.error && outcome.error->kind == support::DiagnosticKind::InvalidMap) {
        verdict.broken = outcome.error->notes;
        verdict.broken.pop_back();  // at which darts
        return verdict;
      }
      if (outcome.error) verdict.error = outcome.error->message;
      verdict.broken = gmap::validate(state.map, state.store);
    } catch (const support::InternalError& error) {
      // Only a rule that was rejected can leave links to removed darts.
      if (!session_.options.force) throw;
      const std::string_view text = error.what();
      verdict.broken = {std::string(text.substr(text.rfind(": ") + 2))};
    }
    return verdict;
  }

  /// Removes darts as long as the same kind of failure stays.
  Trial shrink(Trial trial, bool wants_broken) {
    for (bool smaller = true; smaller;) {
      smaller = false;
      for (std::uint32_t d = 0; d < trial.map.dart_end(); ++d) {
        const DartId dart{d};
        if (!trial.map.alive(dart) ||
            std::find(trial.hooks.begin(), trial.hooks.end(), dart) != trial.hooks.end())
          continue;
        Trial candidate{without(trial.map, dart), trial.hooks, trial.seed};
        const Verdict verdict = judge(candidate);
        if (wants_broken ? verdict.broken.empty() : verdict.error.empty()) continue;
        trial = std::move(candidate);
        smaller = true;
      }
    }
    return trial;
  }

  void print_trial(const Trial& trial) {
    std::vector<std::uint32_t> hooks;
    for (const DartId hook : trial.hooks) hooks.push_back(index(hook));
    session_.out << fmt::format("smallest map found, dimension {}, applied at dart {}:\n{}",
                                program_.dimension, fmt::join(hooks, ", "), map_text(trial.map));
  }

  bool report_broken(const Trial& trial) {
    const Verdict verdict = judge(trial);
    session_.out << fmt::format("{} breaks a map of dimension {}:\n", session_.options.rule,
                                program_.dimension);
    for (const std::string& axiom : verdict.broken) session_.out << "  " << axiom << '\n';
    print_trial(trial);
    return false;
  }

  void report_result() {
    session_.out << fmt::format("{}, dimension {}: {} maps, applied to {}, every map stayed valid\n",
                                session_.options.rule, program_.dimension, session_.options.trials,
                                applied_);
    if (errors_ == 0) return;
    const Trial smallest = shrink(std::move(*first_error_), false);
    session_.out << fmt::format("{} of them were left as they were after a run-time error: {}\n",
                                errors_, judge(smallest).error);
    print_trial(smallest);
  }

  Session& session_;
  const check::CheckedRules& rules_;
  compile::Program program_;
  std::mt19937_64 random_;
  std::optional<NamedItem> item_;
  engine::Arguments arguments_;
  std::unique_ptr<Trial> first_error_;
  std::uint64_t applied_ = 0, errors_ = 0;
};

bool is_present(const check::RuleLibrary& library, const std::string& name) {
  return library.find_rule(name) != nullptr || library.find_operation(name) != nullptr;
}

/// With `--force` a rule that the checker rejects is tried, too.
check::CheckedRules rules_to_try(Session& session) {
  check::LibraryOptions library;
  library.stdlib_folder = session.options.stdlib_folder;
  library.keep_rejected = session.options.force;
  const std::vector<std::filesystem::path> files(session.options.files.begin(),
                                                 session.options.files.end());
  return check::check_rules(files, library, session.sources, session.diagnostics);
}

}  // namespace

int run_fuzz(Session& session) {
  const check::CheckedRules rules = rules_to_try(session);
  if (session.diagnostics.has_errors()) {
    const int code = session.finish();
    const auto there = [&](int n) { return is_present(rules.in(n), session.options.rule); };
    if (!session.options.force || !(there(1) || there(2) || there(3))) return code;
    session.out << fmt::format("`{}` is tried although the checker rejects it or what is beside it\n",
                               session.options.rule);
  }
  Options options = session.options;
  if (!options.has_seed) options.seed = std::random_device{}();
  Session seeded(options, session.out, session.err);
  session.out << fmt::format("seed {}\n", options.seed);
  bool good = true, tried = false;
  for (int dimension : {1, 2, 3}) {
    const bool asked = options.dimension == dimension;
    if (options.dimension != 0 ? !asked : !is_present(rules.in(dimension), options.rule)) continue;
    tried = true;
    good = Fuzzer(seeded, rules, dimension).run() && good;
  }
  if (!tried) good = Fuzzer(seeded, rules, 2).run();
  const int code = seeded.finish();
  return code == kDone && !good ? kStopped : code;
}

}  // namespace gmsim::cli
