// SPDX-License-Identifier: MIT
// The planned matcher against the naive one and against the reference by definition, on random
// patterns in random maps.
#include <doctest/doctest.h>

#include "support/engine_maps.h"
#include "support/library_schemes.h"
#include "support/reference_rewriter.h"
#include "support/rule_hosts.h"
#include "support/rule_mutants.h"
#include "support/scheme_text.h"

using namespace gmsim;
using namespace gmsim::tests;

namespace {

struct Counts {
  int matched = 0;
  int refused = 0;
};

std::vector<std::vector<types::DartId>> row_set(const ReferenceMatch& match) {
  std::vector<std::vector<types::DartId>> rows;
  for (std::size_t row = 0; row < match.darts.size(); ++row) {
    std::vector<types::DartId> all = to_darts(match.darts[row]);
    for (int next : match.next[row]) {
      const std::vector<types::DartId> other = to_darts(match.darts[next]);
      all.insert(all.end(), other.begin(), other.end());
    }
    rows.push_back(std::move(all));
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

/// One pattern on one map: the three matchers at any hooks.
class Comparison {
 public:
  Comparison(const check::Rule& rule, const TinyMap& tiny)
      : rule_(rule), tiny_(tiny), state_(program_, to_gmap(tiny)),
        planned_(state_), naive_(state_, engine::MatcherKind::Naive),
        plan_(compile::compile_pattern(rule.left, rule.hooks)) {}

  void at(const std::vector<int>& hooks, Counts& counts) {
    CAPTURE(hooks);
    engine::Frame frame(rule_.frame_size);
    engine::Match by_plan, by_trial;
    const bool holds = planned_.match(plan_, to_darts(hooks), frame, by_plan);
    const auto reference = reference_match(tiny_, rule_.left, rule_.hooks, hooks);
    REQUIRE(holds == reference.has_value());
    REQUIRE(naive_.match(plan_, to_darts(hooks), frame, by_trial) == holds);
    ++(holds ? counts.matched : counts.refused);
    if (!holds) {
      CHECK(planned_.failure().reason != engine::MatchFailure::Reason::None);
      CHECK(!engine::describe(planned_.failure(), plan_).empty());
      return;
    }
    const auto rows = tests::row_set(by_plan, rule_.left.nodes.size());
    CHECK(rows == row_set(*reference));
    CHECK(rows == tests::row_set(by_trial, rule_.left.nodes.size()));
    if (!hooks.empty()) CHECK(by_plan.dart(0, plan_.hooks[0]) == to_darts(hooks)[0]);
  }

 private:
  const check::Rule& rule_;
  const TinyMap& tiny_;
  compile::Program program_;
  engine::State state_;
  engine::Matcher planned_;
  engine::Matcher naive_;
  compile::MatchPlan plan_;
};

void compare_on(const check::Rule& rule, const TinyMap& map, const std::vector<int>& hooks,
                Random& random, Counts& counts) {
  Comparison comparison(rule, map);
  if (!hooks.empty()) comparison.at(hooks, counts);
  for (int attempt = 0; attempt < 6; ++attempt) {
    std::vector<int> tried;
    for (std::size_t k = 0; k < rule.hooks.size(); ++k) {
      int dart = below(random, map.size());
      while (map.dead[dart]) dart = below(random, map.size());
      tried.push_back(dart);
    }
    comparison.at(tried, counts);
  }
}

void compare(const check::Rule& given, Random& random, Counts& counts) {
  if (!can_compile(given.left, given.hooks, given.dimension)) return;
  const check::Rule rule = with_slots(given);
  CAPTURE(to_text(rule));
  if (const auto host = host_of(rule, random)) {
    compare_on(rule, host->map, host->hook_darts, random, counts);
  }
  compare_on(rule, random_tiny_map(rule.dimension, random), {}, random, counts);
}

/// Some links of the pattern become paths over unnamed darts.
check::Rule with_paths(check::Rule rule, Random& random) {
  for (int k = 0; k < 2 && !rule.left.nodes.empty(); ++k) {
    const int count = static_cast<int>(rule.left.nodes.size());
    check::PatternPath path;
    path.from = static_cast<check::NodeIndex>(below(random, count));
    path.to = static_cast<check::NodeIndex>(below(random, count));
    for (int i = 0; i < 2 + below(random, 2); ++i) {
      path.dimensions.push_back(below(random, rule.dimension + 1));
    }
    rule.left.paths.push_back(path);
  }
  return rule;
}

}  // namespace

TEST_CASE("library patterns are matched alike by plan, by trial and by definition") {
  constexpr std::uint64_t kSeed = 20260101;
  CAPTURE(kSeed);
  Random random(kSeed);
  Counts counts;
  for (const auto* schemes : {&sound_schemes(), &unsound_schemes()}) {
    for (const NamedScheme& scheme : *schemes) {
      for (int round = 0; round < 12; ++round) {
        compare(rule_from_text(scheme.text, scheme.dimension), random, counts);
      }
    }
  }
  CHECK(counts.matched > 500);
  CHECK(counts.refused > 500);
}

TEST_CASE("mutants and random patterns are matched alike by plan, by trial and by definition") {
  constexpr std::uint64_t kSeed = 20260102;
  CAPTURE(kSeed);
  Random random(kSeed);
  Counts counts;
  for (int round = 0; round < 1500; ++round) {
    CAPTURE(round);
    const auto& schemes = sound_schemes();
    const NamedScheme& scheme = schemes[random() % schemes.size()];
    compare(mutate(rule_from_text(scheme.text, scheme.dimension), random).rule, random, counts);
    const int dimension = 1 + below(random, 3);
    const check::Rule rule = random_rule(dimension, random);
    compare(rule, random, counts);
    compare(with_paths(rule, random), random, counts);
  }
  CHECK(counts.matched > 3000);
  CHECK(counts.refused > 3000);
}
