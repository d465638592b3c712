// SPDX-License-Identifier: MIT
// The rewriter against the reference by definition: the same map, dart by dart.
#include <doctest/doctest.h>

#include <algorithm>

#include "check/passes.h"
#include "engine/rewrite.h"
#include "gmap/validate.h"
#include "support/engine_maps.h"
#include "support/library_schemes.h"
#include "support/map_oracle.h"
#include "support/reference_rewriter.h"
#include "support/rule_hosts.h"
#include "support/rule_mutants.h"
#include "support/scheme_text.h"

using namespace gmsim;
using namespace gmsim::tests;

namespace {

struct Counts {
  int applied = 0;
  int broken = 0;
};

/// Which dart of the reference each dart of the engine is. Kept darts have equal names; created
/// ones are numbered row by row, in the order of the match table.
std::vector<int> reference_names(const compile::Rule& rule, const check::Rule& checked,
                                 const engine::Match& match, const ReferenceMatch& reference,
                                 const ReferenceRewrite& result, int old_size) {
  std::vector<int> names(result.map.links.size(), kNone);
  for (int d = 0; d < old_size; ++d) names[d] = d;
  int created = old_size;
  for (std::uint32_t row = 0; row < match.rows; ++row) {
    std::size_t same = 0;  // the row of the reference with the same darts
    if (!rule.match.hooks.empty()) {
      const int hook = static_cast<int>(types::index(match.dart(row, rule.match.hooks[0])));
      while (reference.darts[same][rule.match.hooks[0]] != hook) ++same;
    }
    for (check::NodeIndex node = 0; node < checked.right.nodes.size(); ++node) {
      if (!checked.right_to_left[node]) names[created++] = result.darts[same][node];
    }
  }
  return names;
}

/// Labels of the right as long as those of the left, links that the map has, none by a path.
bool can_rewrite(const check::Rule& rule) {
  const std::size_t length = rule.left.nodes.empty() ? 0 : rule.left.nodes.front().label.size();
  for (const check::PatternNode& node : rule.right.nodes) {
    if (node.label.size() != length) return false;
    if (std::any_of(node.label.begin(), node.label.end(),
                    [&](int i) { return i > rule.dimension; })) {
      return false;
    }
  }
  return std::all_of(rule.right.arcs.begin(), rule.right.arcs.end(),
                     [&](const check::PatternArc& arc) { return arc.dimension <= rule.dimension; });
}

/// With such a schema plans of accepted rules say what becomes of orbits; without, all is left to
/// repairs.
gmap::EmbeddingSchema every_orbit_type(int dimension) {
  gmap::EmbeddingSchema schema;
  for (const OrbitType type : all_types(dimension)) {
    gmap::EmbeddingDecl embedding;
    embedding.name = types::to_string(type);
    embedding.orbit = type;
    schema.add(embedding);
  }
  return schema;
}

void compare(const check::Rule& given, const Host& host, Counts& counts) {
  if (!can_compile(given.left, given.hooks, given.dimension) || !can_rewrite(given)) return;
  const check::Rule checked = with_slots(given);
  CAPTURE(to_text(checked));
  CAPTURE(to_string(host.map));
  const auto reference = reference_match(host.map, checked.left, checked.hooks, host.hook_darts);
  if (!reference) return;
  const ReferenceRewrite expected = reference_rewrite(host.map, checked, *reference);
  if (!flaw(expected.map).empty()) {
    ++counts.broken;
    return;
  }
  compile::Program program;
  program.dimension = checked.dimension;
  support::Diagnostics unread;
  if (host.map.size() % 2 == 0 && check::check_topology(checked, unread)) {
    program.schema = every_orbit_type(checked.dimension);
  }
  const compile::Rule rule = compile::compile_rule(checked, program.schema);
  engine::State state(program, to_gmap(host.map));
  for (const OrbitType type : all_types(checked.dimension)) state.store.use_index(type);
  engine::Matcher matcher(state);
  engine::Frame frame(rule.frame_size);
  engine::Match match;
  REQUIRE(matcher.match(rule.match, to_darts(host.hook_darts), frame, match));
  const std::vector<int> names =
      reference_names(rule, checked, match, *reference, expected, host.map.size());

  engine::Rewriter rewriter(state);
  REQUIRE(rewriter.apply(rule, to_darts(host.hook_darts)).applied());
  ++counts.applied;
  REQUIRE(state.map.dart_end() == names.size());
  const std::vector<std::string> broken = gmap::validate(state.map, state.store);
  if (!broken.empty()) FAIL_CHECK(broken.front());
  for (std::uint32_t d = 0; d < names.size(); ++d) {
    CAPTURE(d);
    REQUIRE(state.map.alive(DartId{d}) == !expected.map.dead[names[d]]);
    if (!state.map.alive(DartId{d})) continue;
    for (int i = 0; i <= checked.dimension; ++i) {
      CHECK(names[types::index(state.map.alpha(i, DartId{d}))] == expected.map.links[names[d]][i]);
    }
  }
}

}  // namespace

TEST_CASE("library rules rewrite as the definition says") {
  constexpr std::uint64_t kSeed = 20260103;
  CAPTURE(kSeed);
  Random random(kSeed);
  Counts counts;
  for (const NamedScheme& scheme : sound_schemes()) {
    CAPTURE(scheme.name);
    const check::Rule rule = rule_from_text(scheme.text, scheme.dimension);
    for (int round = 0; round < 60; ++round) {
      if (const auto host = host_of(rule, random)) compare(rule, *host, counts);
    }
  }
  CHECK(counts.applied > 1000);
  CHECK(counts.broken == 0);
}

TEST_CASE("mutants that leave a valid map rewrite as the definition says") {
  constexpr std::uint64_t kSeed = 20260104;
  CAPTURE(kSeed);
  Random random(kSeed);
  Counts counts;
  for (int round = 0; round < 6000; ++round) {
    CAPTURE(round);
    const auto& schemes = sound_schemes();
    const NamedScheme& scheme = schemes[random() % schemes.size()];
    const check::Rule rule =
        round % 3 == 0 ? random_rule(1 + below(random, 3), random)
                       : mutate(rule_from_text(scheme.text, scheme.dimension), random).rule;
    if (const auto host = host_of(rule, random)) compare(rule, *host, counts);
  }
  CHECK(counts.applied > 500);
  CHECK(counts.broken > 100);
}
