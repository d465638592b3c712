// SPDX-License-Identifier: MIT
#include "stdlib/block_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include "compile/compile.h"
#include "engine/enumerate.h"
#include "engine/operation.h"
#include "engine/rewrite.h"
#include "gmap/orbit_walk.h"
#include "stdlib/block_state.h"
#include "stdlib/spring_run.h"

namespace gmsim::test {
namespace {

using types::DartId;
using types::OrbitType;

constexpr double kTolerance = 1e-12;
constexpr double kForceTolerance = 1e-6;  // of centred differences

bool close(double a, double b, double tolerance) {
  return std::abs(a - b) <= tolerance * std::max({1.0, std::abs(a), std::abs(b)});
}

/// `apply` in a form with all its settings, whether the block gives one or a list.
std::vector<YAML::Node> applications(const YAML::Node& block) {
  const YAML::Node apply = block["apply"];
  if (!apply) return {};
  if (apply.IsScalar()) return {block};
  return {apply.begin(), apply.end()};
}

class BlockRun {
 public:
  BlockRun(const TestBlock& block, engine::MatcherKind matcher)
      : yaml_(block.yaml),
        state_(block),
        rewriter_(state_.state(), {.matcher = matcher, .validate = true}) {}

  std::vector<std::string> run() {
    refuse_unknown_keys();
    for (const auto& entry : yaml_["set"])
      state_.set(entry.first.as<std::string>(), entry.second.as<std::string>());
    for (const YAML::Node& application : applications(yaml_)) apply(application);
    if (const std::string invalid = state_.invalid(); !invalid.empty()) fail(invalid);
    if (yaml_["not_applied"]) expect_count("applied", applied_, 0);
    check_matches();
    if (yaml_["interaction"])
      check_interaction();
    else
      for (const auto& entry : yaml_["expect"]) expect(entry.first.as<std::string>(), entry.second);
    return failures_;
  }

 private:
  void refuse_unknown_keys() {
    static const std::set<std::string> known = {
        "about", "mesh",   "density",     "rules",   "set",         "apply", "to",       "where",
        "times", "params", "not_applied", "matches", "interaction", "move",  "criteria", "expect",
        "at"};
    for (const auto& entry : yaml_)
      if (!known.contains(entry.first.as<std::string>()))
        fail(fmt::format("a test block has no key `{}`", entry.first.as<std::string>()));
  }

  void fail(std::string message) { failures_.push_back(std::move(message)); }
  void expect_count(const std::string& what, std::uint64_t found, std::uint64_t wanted) {
    if (found != wanted) fail(fmt::format("{} is {}, expected {}", what, found, wanted));
  }
  void expect_close(const std::string& what, double found, double wanted,
                    double tolerance = kTolerance) {
    if (!close(found, wanted, tolerance))
      fail(fmt::format("{} is {}, expected {}", what, found, wanted));
  }

  // ---- applying rules ---------------------------------------------------------------------------

  [[nodiscard]] std::vector<DartId> candidates(const YAML::Node& node, OrbitType orbit) {
    if (node["to"]) orbit = state_.orbit(node["to"].as<std::string>());
    std::optional<check::CheckedExpression> where;
    if (node["where"])
      where = state_.expression(node["where"].as<std::string>(), {types::ValueKind::Bool});
    std::vector<DartId> darts;
    for (const DartId dart : gmap::all_orbits(state_.state().map, orbit))
      if (!where || state_.holds(*where, dart)) darts.push_back(dart);
    return darts;
  }

  [[nodiscard]] engine::Arguments arguments(const YAML::Node& params,
                                            const compile::ItemHead& item) {
    engine::Arguments given;
    for (const auto& entry : params) {
      const auto* parameter = item.find_parameter(entry.first.as<std::string>());
      if (!parameter)
        throw std::runtime_error(item.name + " has no parameter " + entry.first.as<std::string>());
      types::Value value{.type = parameter->type};
      value.data = state_.value(entry.second.as<std::string>(), DartId{0}, parameter->type);
      given.emplace_back(parameter->slot, std::move(value));
    }
    return given;
  }

  void apply(const YAML::Node& node) {
    const auto name = node["apply"].as<std::string>();
    const int times = node["times"] ? node["times"].as<int>() : 1;
    const compile::Rule* rule = state_.program().find_rule(name);
    const compile::Operation* operation = state_.program().find_operation(name);
    if (!rule && !operation) throw std::runtime_error("no rule or operation `" + name + "`");
    for (int i = 0; i < times; ++i) {
      const engine::RewriteOutcome outcome =
          rule ? apply_rule(*rule, node) : apply_operation(*operation, node);
      if (outcome.error) fail(name + " failed: " + outcome.error->message);
      applied_ += outcome.effects.applications;
    }
  }

  engine::RewriteOutcome apply_rule(const compile::Rule& rule, const YAML::Node& node) {
    const engine::Arguments given = arguments(node["params"], rule);
    if (node["at"]) {
      std::vector<DartId> hooks;
      for (const auto& dart : node["at"]) hooks.push_back(DartId{dart.as<std::uint32_t>()});
      return rewriter_.apply(rule, hooks, given);
    }
    if (rule.match.hooks.empty()) return rewriter_.apply(rule, {}, given);
    const auto darts = candidates(node, rule.match.hook_orbit());
    return rewriter_.apply_everywhere(rule, darts, given);
  }

  engine::RewriteOutcome apply_operation(const compile::Operation& operation,
                                         const YAML::Node& node) {
    return engine::OperationRunner(rewriter_).run_each(
        operation, candidates(node, operation.orbit), arguments(node["params"], operation));
  }

  // ---- what came out ----------------------------------------------------------------------------

  [[nodiscard]] std::optional<std::uint64_t> count(const std::string& what) {
    const gmap::GMap& map = state_.state().map;
    static const std::map<std::string, int> cells = {
        {"vertices", 0}, {"edges", 1}, {"faces", 2}, {"volumes", 3}};
    if (what == "applied") return applied_;
    if (what == "darts") return map.dart_count();
    if (what == "components")
      return gmap::all_orbits(map, OrbitType::range(0, map.dimension())).size();
    const auto cell = cells.find(what);
    if (cell == cells.end()) return std::nullopt;
    if (cell->second > map.dimension()) throw std::runtime_error("no " + what + " here");
    return gmap::all_orbits(map, OrbitType::cell(cell->second, map.dimension())).size();
  }

  [[nodiscard]] DartId some_dart() {
    const auto darts = gmap::all_orbits(state_.state().map, {});
    return darts.empty() ? DartId{0} : darts.front();
  }

  void expect(const std::string& what, const YAML::Node& wanted) {
    if (const auto found = count(what)) return expect_count(what, *found, wanted.as<std::uint64_t>());
    const auto found = state_.value(what, some_dart());
    if (wanted.as<std::string>() == "true" || wanted.as<std::string>() == "false")
      return expect_count(what, found.at(0) != 0, wanted.as<bool>());
    if (wanted.IsScalar()) return expect_close(what, found.at(0), wanted.as<double>());
    for (std::size_t k = 0; k < found.size(); ++k)
      expect_close(what, found[k], wanted[k].as<double>());
  }

  void check_matches() {
    for (const auto& entry : yaml_["matches"]) {
      const auto name = entry.first.as<std::string>();
      const check::Interaction* item = state_.library().find_interaction(name);
      if (!item) throw std::runtime_error("no interaction `" + name + "`");
      const auto plan = compile::compile_pattern(item->match, {item->hook});
      std::uint64_t found = 0;
      const auto error = engine::for_each_match(
          rewriter_.matcher(), state_.state(), plan, item->frame_size, {},
          {.orbit = item->orbit, .first = item->first.get(), .first_dart = item->first_dart},
          [&](DartId, const engine::Match&, engine::Frame&) { ++found; });
      if (error) fail(error->message);
      expect_count("matches of " + name, found, entry.second.as<std::uint64_t>());
    }
  }

  void check_interaction() {
    // `where` chooses matches here unless the block applies a rule, which it then belongs to.
    const YAML::Node where = yaml_["apply"] ? YAML::Node(YAML::NodeType::Undefined) : yaml_["where"];
    SpringRun spring(state_, yaml_["interaction"].as<std::string>(), yaml_["params"], where);
    if (yaml_["move"]) state_.set("position", yaml_["move"].as<std::string>());
    for (const auto& entry : yaml_["expect"]) {
      const auto what = entry.first.as<std::string>();
      if (what == "matches")
        expect_count(what, spring.match_count(), entry.second.as<std::uint64_t>());
      else if (what == "energy")
        expect_close(what, spring.energy(), entry.second.as<double>());
      else if (what == "finite")
        expect_count(what, std::isfinite(spring.energy()), entry.second.as<bool>());
      else if (what == "force")
        expect_forces(spring, entry.second);
      else
        expect(what, entry.second);
    }
    for (const auto& entry : yaml_["criteria"])
      expect_values(entry.first.as<std::string>(), spring.criterion(entry.first.as<std::string>()),
                    entry.second);
  }

  void expect_forces(SpringRun& spring, const YAML::Node& forces) {
    for (const auto& entry : forces) {
      const auto point = entry.first.as<std::size_t>();
      const auto found = spring.force(state_.point_dart(point));
      for (std::size_t k = 0; k < 3; ++k)
        expect_close(fmt::format("force on point {}, component {},", point, k), found[k],
                     entry.second[k].as<double>(), kForceTolerance);
    }
  }

  void expect_values(const std::string& what, const std::vector<double>& found,
                     const YAML::Node& wanted) {
    expect_count(what + ": values", found.size(), wanted.size());
    for (std::size_t i = 0; i < std::min(found.size(), wanted.size()); ++i)
      expect_close(what, found[i], wanted[i].as<double>());
  }

  const YAML::Node yaml_;
  BlockState state_;
  engine::Rewriter rewriter_;
  std::uint64_t applied_ = 0;
  std::vector<std::string> failures_;
};

}  // namespace

std::vector<std::string> run_block(const TestBlock& block, engine::MatcherKind matcher) {
  try {
    return BlockRun(block, matcher).run();
  } catch (const std::exception& problem) {
    return {problem.what()};
  }
}

}  // namespace gmsim::test
