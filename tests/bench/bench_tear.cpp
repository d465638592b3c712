// SPDX-License-Identifier: MIT
// What it costs when something tears in a running simulation: one edge on small and on large
// meshes, and all edges in one step. To be run from the top folder of the repository.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench/bench_timing.h"
#include "bench/scene_cloth.h"

using namespace gmsim;

namespace {

constexpr double kFlatBar = 3.0;      // one tear at 10^6 darts against one at 10^3
constexpr double kTearBar = 20e-6;    // s
constexpr double kCascadeBar = 13.0;  // 10^5 separations against 10^4
constexpr int kTears = 40;

/// The cloth of a scene with about so many darts.
bench::SceneCloth cloth_of(const std::string& file, double darts) {
  return {file, static_cast<std::uint32_t>(std::lround(std::sqrt(darts / 8))),
          std::vector<std::string>{}};
}

void print_heading(const char* first) {
  fmt::print("{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}{:>8}{:>9}{:>9}\n", first, "rewrite",
             "tables", "vertices", "forces", "criteria", "total", "touched", "matches", "fields");
}

void print_cost(std::uint64_t first, const engine::ChangeCost& cost, double unit, double events) {
  fmt::print("{:>10}", first);
  for (const double part :
       {cost.rewrite, cost.tables, cost.vertices, cost.forces, cost.criteria, cost.total()})
    fmt::print("{:>10.1f}", part / unit);
  fmt::print("{:>8.1f}{:>9.1f}{:>9.1f}\n", static_cast<double>(cost.touched_darts) / events,
             static_cast<double>(cost.matches) / events,
             static_cast<double>(cost.criterion_matches) / events);
}

/// The median tear.
engine::ChangeCost one_tear(double darts, std::uint32_t& actual) {
  bench::SceneCloth cloth = cloth_of("tests/bench/tear_one.yaml", darts);
  actual = cloth.darts();
  std::vector<engine::ChangeCost> costs;
  for (int tear = 0; tear < kTears; ++tear) {
    const engine::StepReport report = cloth.step();
    if (report.events.size() == 1) costs.push_back(report.cost);
  }
  const auto middle = costs.begin() + static_cast<std::ptrdiff_t>(costs.size() / 2);
  std::nth_element(costs.begin(), middle, costs.end(), [](const auto& a, const auto& b) {
    return a.total() < b.total();
  });
  return *middle;
}

bool judge(const char* what, double value, double bar) {
  fmt::print("{}: {:.3g}, bar {:.3g}: {}\n", what, value, bar, value <= bar ? "pass" : "MISS");
  return value <= bar;
}

/// Bars speak of the largest meshes.
bool not_judged() {
  fmt::print("not judged: the largest meshes were left out\n");
  return true;
}

bool tears(double largest) {
  fmt::print("one tear, microseconds\n");
  print_heading("darts");
  double first = 0, last = 0;
  for (const double darts : {1e3, 1e4, 1e5, 1e6}) {
    if (darts > largest) break;
    std::uint32_t actual = 0;
    const engine::ChangeCost cost = one_tear(darts, actual);
    print_cost(actual, cost, 1e-6, 1);
    last = cost.total();
    if (first == 0) first = last;
  }
  if (largest < 1e6) return not_judged();
  const bool flat = judge("largest mesh against smallest", last / first, kFlatBar);
  return judge("microseconds a tear", last * 1e6, kTearBar * 1e6) && flat;
}

/// The fastest of a few cascades.
engine::ChangeCost cascade(double separations, std::size_t& events) {
  engine::ChangeCost best;
  for (int repetition = 0; repetition < 3; ++repetition) {
    bench::SceneCloth cloth = cloth_of("tests/bench/tear_cascade.yaml", separations * 4);
    engine::StepReport report;
    while (report.events.empty()) report = cloth.step();
    if (best.total() == 0 || report.cost.total() < best.total()) best = report.cost;
    events = report.events.size();
  }
  return best;
}

bool cascades(double largest) {
  fmt::print("\nall edges in one step, milliseconds\n");
  print_heading("events");
  double first = 0, ratio = 0;
  for (const double separations : {1e4, 1e5}) {
    if (separations * 4 > largest) break;
    std::size_t events = 0;
    const engine::ChangeCost cost = cascade(separations, events);
    print_cost(events, cost, 1e-3, static_cast<double>(events));
    const double each = cost.total() / static_cast<double>(events);
    if (first == 0) first = each;
    ratio = 10 * each / first;
  }
  if (largest < 4e5) return not_judged();
  return judge("ten times as many separations", ratio, kCascadeBar);
}

}  // namespace

/// bench_tear [largest number of darts]
int main(int argc, char** argv) {
  const double largest = argc > 1 ? std::atof(argv[1]) : 1.01e6;
  bench::keep_memory();
  const bool one = tears(largest);
  return cascades(largest) && one ? 0 : 1;
}
