// SPDX-License-Identifier: MIT
// checker_soundness [--trials N] [--seed S | --seed fresh]: random rules and mutants against brute
// force. Exits with 1 when a bar is missed.
#include <cstdlib>
#include <iostream>
#include <random>
#include <string>

#include "check/check.h"
#include "property/checker_trials.h"
#include "support/library_schemes.h"
#include "support/mesh_groups.h"
#include "support/scheme_text.h"
#include "support/source_map.h"

namespace gmsim::tests {
namespace {

constexpr double kAppliedShare = 0.20;      ///< of all trials: accepted, and applied to a map
constexpr double kAlwaysValidShare = 0.99;  ///< of what never breaks a map: accepted
constexpr std::size_t kListed = 10;

struct Options {
  long trials = 4000;
  std::uint64_t seed = 1;
};

Options read_options(int argc, char** argv) {
  Options options;
  for (int k = 1; k + 1 < argc; k += 2) {
    const std::string name = argv[k], value = argv[k + 1];
    if (name == "--trials") options.trials = std::stol(value);
    if (name == "--seed")
      options.seed = value == "fresh"
                         ? (std::uint64_t{std::random_device{}()} << 32) ^ std::random_device{}()
                         : std::stoull(value);
  }
  return options;
}

std::vector<BaseRule> from_schemes(const std::vector<NamedScheme>& schemes) {
  std::vector<BaseRule> rules;
  for (const NamedScheme& scheme : schemes)
    rules.push_back({scheme.name, rule_from_text(scheme.text, scheme.dimension)});
  return rules;
}

/// The topology of every rule of the library, in every dimension.
void add_library(std::vector<BaseRule>& rules) {
  support::SourceMap sources;
  support::Diagnostics diagnostics;
  const check::CheckedRules library = check::check_rules({}, {}, sources, diagnostics);
  for (int n = 1; n <= 3; ++n)
    for (check::Rule rule : library.in(n).rules) {
      if (!rule.has_right) continue;
      rule.steps.clear();
      rule.assignments.clear();
      rules.push_back({"library's " + rule.name, std::move(rule)});
    }
}

TinyMap tiny(const gmap::GMap& map) {
  TinyMap result;
  result.dimension = map.dimension();
  for (std::uint32_t d = 0; d < map.dart_end(); ++d) result.add_dart();
  for (std::uint32_t d = 0; d < map.dart_end(); ++d)
    for (int i = 0; i <= map.dimension(); ++i)
      result.links[d][i] = static_cast<int>(types::index(map.alpha(i, types::DartId{d})));
  return result;
}

std::vector<TinyMap> mesh_maps() {
  std::vector<TinyMap> maps;
  for (const NamedMesh& group : mesh_groups()) {
    const gmap::MeshMap built = gmap::build_map(group.mesh);
    if (built.map.dart_count() > 0) maps.push_back(tiny(built.map));
  }
  for (int n = 1; n <= 3; ++n)
    for (std::uint64_t seed = 0; seed < 10; ++seed) maps.push_back(tiny(random_map(n, 24, seed)));
  return maps;
}

double share(long part, long whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

void list(const char* title, const std::vector<std::string>& entries) {
  if (entries.empty()) return;
  std::cout << title << ": " << entries.size() << "\n";
  for (std::size_t k = 0; k < entries.size() && k < kListed; ++k)
    std::cout << "  " << entries[k] << "\n";
}

bool bar(const char* what, bool met) {
  std::cout << (met ? "  met     " : "  MISSED  ") << what << "\n";
  return met;
}

bool report(const TrialCounts& counts) {
  for (const auto& [verdict, count] : counts.by_verdict)
    std::cout << "  " << verdict << ": " << count << "\n";
  std::cout << "accepted " << 100 * share(counts.accepted, counts.trials)
            << " %, accepted and applied " << 100 * share(counts.applied, counts.trials)
            << " % of the trials, " << counts.applications << " applications\n";
  std::cout << "always valid by brute force: " << counts.always_valid << ", of these accepted "
            << 100 * share(counts.always_valid_accepted, counts.always_valid) << " %\n";
  for (const auto& [kind, rules] : counts.over_rejected)
    list(("always valid, yet rejected as " + kind).c_str(), rules);
  list("UNSOUND", counts.unsound);
  std::cout << "values: " << counts.value_checks << " orbit types looked at, "
            << 100 * share(counts.values_accepted, counts.value_checks) << " % accepted\n";
  list("UNSOUND values", counts.values_unsound);
  list("values that brute force finds always right, yet rejected", counts.values_over_rejected);

  const double over =
      share(static_cast<long>(counts.values_over_rejected.size()), counts.value_checks);
  bool good = bar("no rule accepted that breaks a map", counts.unsound.empty());
  good &= bar("at least 20 % of the trials accepted and applied",
              share(counts.applied, counts.trials) >= kAppliedShare);
  good &= bar("at least 99 % of what is always valid accepted",
              share(counts.always_valid_accepted, counts.always_valid) >= kAlwaysValidShare);
  good &= bar("no orbit left without exactly one value", counts.values_unsound.empty());
  good &=
      bar("at most 1 % of the value checks rejected without need", over <= 1 - kAlwaysValidShare);
  return good;
}

}  // namespace
}  // namespace gmsim::tests

int main(int argc, char** argv) {
  using namespace gmsim::tests;
  const Options options = read_options(argc, argv);
  std::cout << "seed " << options.seed << ", " << options.trials << " trials" << std::endl;
  std::vector<BaseRule> sound = from_schemes(sound_schemes());
  const std::size_t schemes = sound.size();
  add_library(sound);
  std::cout << schemes << " schemes and " << sound.size() - schemes
            << " rules of the library to start from\n";
  CheckerTrials trials(std::move(sound), from_schemes(unsound_schemes()), mesh_maps(),
                       options.seed);
  trials.run(options.trials);
  return report(trials.counts()) ? EXIT_SUCCESS : EXIT_FAILURE;
}
