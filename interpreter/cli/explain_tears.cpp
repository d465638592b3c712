// SPDX-License-Identifier: MIT
#include "cli/explain_tears.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ostream>
#include <span>
#include <string>

namespace gmsim::cli {
namespace {

constexpr std::size_t kBars = 10;
constexpr std::size_t kWidth = 50;

/// Counts of matches in ten parts of the way to the threshold, and those beyond.
void print_histogram(std::span<const double> ratios, std::ostream& out) {
  std::array<std::size_t, kBars + 1> counts{};
  for (const double ratio : ratios) {
    const double bar = std::clamp(ratio * kBars, 0.0, double{kBars});
    ++counts[static_cast<std::size_t>(bar)];
  }
  const std::size_t most = *std::max_element(counts.begin(), counts.end());
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const std::size_t length = most == 0 ? 0 : (counts[k] * kWidth + most - 1) / most;
    const std::string range = k < kBars ? fmt::format("{:>3} %", 10 * k) : "above";
    out << fmt::format("    {:>5}  {:>7}  {}\n", range, counts[k], std::string(length, '#'));
  }
}

}  // namespace

void explain_tears(const scene::Scene& scene, engine::Simulation& simulation, std::ostream& out,
                   support::Diagnostics& diagnostics) {
  const auto reports = simulation.survey(diagnostics);
  if (!reports) return;
  if (reports->empty()) out << "nothing can tear: the scene has no `tear:` section\n";
  for (std::size_t i = 0; i < reports->size(); ++i) {
    const engine::TearPairing& tear = scene.model.tears[i];
    const auto& [nearest, ratios] = (*reports)[i];
    out << fmt::format("{}:\n", scene.program.criteria[tear.criterion].name);
    if (nearest.where == gmap::kNoDart) {
      out << "  never judged: its pattern holds nowhere that `where` allows, or `after` was not reached\n";
      continue;
    }
    out << fmt::format(
        "  nearest to tearing at t = {:.6g} s: {:.6g}, {:.4g} times the threshold {:.6g}\n"
        "  there: vertex ({:.4g}, {:.4g}, {:.4g}), dart {}\n",
        nearest.time, nearest.value, nearest.value / nearest.threshold, nearest.threshold,
        nearest.position[0], nearest.position[1], nearest.position[2],
        types::index(nearest.where));
    out << fmt::format("  {} places at the end that may tear, by share of the threshold:\n", ratios.size());
    print_histogram(ratios, out);
  }
}

}  // namespace gmsim::cli
