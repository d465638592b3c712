// SPDX-License-Identifier: MIT
// Rules of the library on large meshes: ns per dart of the mesh before the job, every application
// matched, rewritten and with all its upkeep done before the next. And what one cut costs on a small
// and on a large map.
#include <fmt/format.h>

#include <functional>
#include <string>
#include <vector>

#include "bench/bench_timing.h"
#include "engine/operation.h"
#include "engine/rewrite.h"
#include "gmap/mesh_builders.h"
#include "gmap/orbit_walk.h"
#include "gmap/validate.h"
#include "support/engine_rules.h"

using namespace gmsim;
using namespace gmsim::bench;
using types::DartId;

namespace {

constexpr double kBar = 150.0;    // ns per dart
constexpr double kLocalBar = 3.0; // one cut at 10^6 darts against one at 10^3

struct Job {
  std::string name;
  std::vector<double> seconds = {};
  engine::Effects effects = {};
};

/// A mesh with its positions, or with all data of particles.rule.
class Jobs {
 public:
  Jobs(const tests::RuleBook& rules, const gmap::Mesh& mesh, bool all_data)
      : rules_(rules), mesh_(mesh), all_data_(all_data) {}

  /// Those jobs whose name begins so; to separate and to sew goes together.
  void repeat(std::string_view chosen) {
    const auto wanted = [&](const Job& job) { return job.name.starts_with(chosen); };
    if (wanted(jobs_[0]) || wanted(jobs_[1])) separate_and_sew();
    if (wanted(jobs_[2])) cone();
    if (wanted(jobs_[3])) remove();
  }
  bool report(const std::string& title) const {
    fmt::print("\n{}: {} darts, {}\n", title, darts_,
               all_data_ ? "all data of particles.rule" : "positions only");
    fmt::print("  {:<34}{:>10}{:>7}{:>6}{:>14}{:>14}{:>14}\n", "ns per dart", "", "bar", "",
               "applications", "visited/app.", "values/app.");
    bool passed = true;
    for (const Job& job : jobs_) {
      if (job.seconds.empty()) continue;
      const double ns = 1e9 * median(job.seconds) / darts_;
      const auto applications = static_cast<double>(job.effects.applications);
      passed = passed && ns <= kBar;
      fmt::print("  {:<34}{:>10.1f}{:>7.0f}{:>6}{:>14}{:>14.1f}{:>14.1f}\n", job.name, ns, kBar,
                 ns <= kBar ? "pass" : "MISS", job.effects.applications,
                 static_cast<double>(job.effects.visited_darts()) / applications,
                 static_cast<double>(job.effects.written_values) / applications);
    }
    return passed;
  }

 private:
  using Edges = std::vector<std::pair<DartId, DartId>>;

  [[nodiscard]] std::unique_ptr<engine::State> fresh() {
    auto state = fresh_state();
    darts_ = state->map.dart_count();
    return state;
  }
  [[nodiscard]] std::unique_ptr<engine::State> fresh_state() const {
    if (all_data_) return tests::make_state(rules_.program(), mesh_);
    gmap::MeshMap built = gmap::build_map(mesh_);
    auto state = std::make_unique<engine::State>(rules_.program(), std::move(built.map));
    state->store.use_index({0, 1});
    const types::EmbeddingId position = rules_.embedding("position");
    state->use(position);
    for (std::uint32_t d = 0; d < built.dart_point.size(); ++d) {
      state->store.set(position, DartId{d}, mesh_.points[built.dart_point[d]]);
    }
    return state;
  }
  static Edges inner_edges(const gmap::GMap& map) {
    Edges edges;
    for (std::uint32_t i = 0; i < map.dart_end(); ++i) {
      const DartId d{i}, e = map.alpha(2, d);
      if (e > d && map.alpha(0, d) > d) edges.emplace_back(d, e);
    }
    return edges;
  }
  static void time(Job& job, const std::function<engine::RewriteOutcome()>& work) {
    engine::RewriteOutcome outcome;
    job.seconds.push_back(seconds([&] { outcome = work(); }));
    GMSIM_CHECK(outcome.applied(), outcome.error ? outcome.error->message : job.name);
    job.effects = std::move(outcome.effects);
  }
  static void check(const engine::State& state) {
    GMSIM_CHECK(gmap::validate(state.map, state.store).empty(), "the map is wrong after a job");
  }

  engine::RewriteOutcome sew(engine::Rewriter& rewriter, const Edges& edges) const {
    const compile::Rule& rule = rules_.rule("sew_elements");
    engine::RewriteOutcome all;
    for (const auto& [a, b] : edges) {
      const DartId hooks[] = {a, b};
      rewriter.apply(rule, hooks, {}, all);
      GMSIM_CHECK(all.applied(), "a cut edge can be sewn");
    }
    return all;
  }
  void separate_and_sew() {
    const auto state = fresh();
    engine::Rewriter rewriter(*state);
    const Edges edges = inner_edges(state->map);
    std::vector<DartId> sides;
    for (const auto& [a, b] : edges) sides.push_back(a);
    time(jobs_[0], [&] { return rewriter.apply_each(rules_.rule("separate_elements"), sides); });
    time(jobs_[1], [&] { return sew(rewriter, edges); });
    check(*state);
  }
  void cone() {
    const auto state = fresh();
    engine::Rewriter rewriter(*state);
    const std::vector<DartId> faces = gmap::all_orbits(state->map, {0, 1});
    time(jobs_[2], [&] { return rewriter.apply_each(rules_.rule("triangulate_face"), faces); });
    check(*state);
  }
  void remove() {
    const auto state = fresh();
    engine::Rewriter rewriter(*state);
    engine::OperationRunner runner(rewriter);
    std::vector<DartId> faces, all = gmap::all_orbits(state->map, {0, 1});
    for (std::size_t k = 1; k < all.size(); k += 2) faces.push_back(all[k]);
    time(jobs_[3], [&] { return runner.run_each(rules_.operation("remove_element"), faces); });
    check(*state);
  }

  const tests::RuleBook& rules_;
  const gmap::Mesh& mesh_;
  bool all_data_;
  double darts_ = 0;
  Job jobs_[4] = {{"separate_elements at every edge"},
                  {"sew_elements at every edge"},
                  {"triangulate_face at every face"},
                  {"remove_element, every second face"}};
};

struct LocalCost {
  double darts = 0;
  double microseconds = 0;  // median of one cut
  engine::Effects effects;  // of all cuts
  int cuts = 0;
};

/// Cuts one edge of a grid and sews it again, at edges far from each other; the cuts are timed.
LocalCost local_cut(const tests::RuleBook& rules, std::uint32_t side) {
  const auto state =
      tests::make_state(rules.program(), gmap::grid(side, side, 1.0, 1.0, gmap::GridCells::Quads));
  engine::Rewriter rewriter(*state);
  LocalCost cost;
  cost.darts = state->map.dart_count();
  std::vector<double> times;
  constexpr int kCuts = 2000;
  std::uint32_t d = 0;
  while (cost.cuts < kCuts) {
    d = (d + 40503u * 3) % state->map.dart_end();
    const DartId hooks[] = {DartId{d}, state->map.alpha(2, DartId{d})};
    if (hooks[0] == hooks[1]) continue;
    engine::RewriteOutcome cut;
    times.push_back(seconds([&] { cut = rewriter.apply(rules.rule("separate_elements"), {hooks, 1}); }));
    GMSIM_CHECK(cut.applied() && rewriter.apply(rules.rule("sew_elements"), hooks).applied(),
                "an inner edge can be cut and sewn");
    cost.effects.append(cut.effects);
    ++cost.cuts;
  }
  cost.microseconds = 1e6 * median(times);
  return cost;
}

bool report_local(const tests::RuleBook& rules) {
  const LocalCost small = local_cut(rules, 11), large = local_cut(rules, 354);
  fmt::print("\none separate_elements\n  {:>10}{:>12}{:>10}{:>10}{:>10}\n", "darts", "us",
             "touched", "visited", "values");
  for (const LocalCost& cost : {small, large}) {
    const double cuts = cost.cuts;
    fmt::print("  {:>10.0f}{:>12.3f}{:>10.1f}{:>10.1f}{:>10.1f}\n", cost.darts, cost.microseconds,
               static_cast<double>(cost.effects.touched.size()) / cuts,
               static_cast<double>(cost.effects.visited_darts()) / cuts,
               static_cast<double>(cost.effects.written_values) / cuts);
  }
  const double ratio = large.microseconds / small.microseconds;
  fmt::print("  ratio {:.2f}, bar {:.0f}: {}\n", ratio, kLocalBar,
             ratio <= kLocalBar ? "pass" : "MISS");
  return ratio <= kLocalBar;
}

}  // namespace

int main(int argc, char** argv) {
  bool check = false, with_all_data = true;
  int repetitions = 3;
  std::uint32_t side = 300;
  std::string chosen;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--check") {
      check = true;
    } else if (argument == "--positions") {
      with_all_data = false;
    } else if (argument == "--repetitions" && i + 1 < argc) {
      repetitions = std::max(1, std::atoi(argv[++i]));
    } else if (argument == "--side" && i + 1 < argc) {
      side = static_cast<std::uint32_t>(std::max(2, std::atoi(argv[++i])));
    } else if (argument == "--job" && i + 1 < argc) {
      chosen = argv[++i];
    } else {
      fmt::print("usage: bench_rewrite [--check] [--positions] [--repetitions N] [--job NAME] [--side N]\n"
                 "  --check      exit with 1 when a bar is missed with positions only\n"
                 "  --positions  leave out the runs with all data of particles.rule\n"
                 "  --job NAME   only the jobs whose name begins with NAME\n"
                 "  --side N     a grid of N by N patches (300)\n");
      return argument == "--help" || argument == "-h" ? 0 : 2;
    }
  }
  keep_memory();
  const tests::RuleBook rules("", 2, true);
  bool passed = true;
  for (auto [name, cells] : {std::pair{"quads", gmap::GridCells::Quads},
                             std::pair{"triangles", gmap::GridCells::Triangles}}) {
    const gmap::Mesh mesh = gmap::grid(side, side, 1.0, 1.0, cells);
    for (const bool all_data : {false, true}) {
      if (all_data && !with_all_data) continue;
      Jobs jobs(rules, mesh, all_data);
      for (int k = 0; k < repetitions; ++k) jobs.repeat(chosen);
      const bool within = jobs.report(fmt::format("{0} {1} x {1}", name, side));
      passed = passed && (within || all_data);
    }
  }
  if (chosen.empty()) passed = report_local(rules) && passed;
  return check && !passed ? 1 : 0;
}
