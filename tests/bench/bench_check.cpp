// SPDX-License-Identifier: MIT
// How long it takes to read the whole library: from its texts to checked rules in every dimension of
// the map, and to the plans of one dimension, as every command does before its work.
#include <fmt/format.h>

#include <cstdlib>
#include <string_view>
#include <vector>

#include "bench/bench_timing.h"
#include "check/check.h"
#include "compile/compile.h"
#include "support/check.h"
#include "support/diagnostic.h"
#include "support/source_map.h"

using namespace gmsim;
using namespace gmsim::bench;

namespace {

constexpr double kBar = 20.0;  // ms
constexpr double kAim = 5.0;

struct Times {
  std::vector<double> check, compile[3], total;
};

void measure(Times& times) {
  support::SourceMap sources;
  support::Diagnostics diagnostics;
  check::CheckedRules rules;
  const double checked =
      seconds([&] { rules = check::check_rules({}, {}, sources, diagnostics); });
  GMSIM_CHECK(!diagnostics.has_errors(), "the library has no errors");
  double slowest = 0.0;
  for (int n = 1; n <= 3; ++n) {
    const double compiled = seconds([&] { keep(compile::compile_program(rules.in(n))); });
    times.compile[n - 1].push_back(1e3 * compiled);
    slowest = std::max(slowest, compiled);
  }
  times.check.push_back(1e3 * checked);
  times.total.push_back(1e3 * (checked + slowest));
}

}  // namespace

int main(int argc, char** argv) {
  bool must_pass = false;
  int repetitions = 25;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--check") {
      must_pass = true;
    } else if (argument == "--repetitions" && i + 1 < argc) {
      repetitions = std::max(1, std::atoi(argv[++i]));
    } else {
      fmt::print("usage: bench_check [--check] [--repetitions N]\n"
                 "  --check  exit with 1 when the bar is missed\n");
      return argument == "--help" || argument == "-h" ? 0 : 2;
    }
  }
  Times times;
  double first = 0.0;
  for (int k = 0; k < repetitions; ++k) {
    measure(times);
    if (k == 0) first = times.total.front();
  }
  const double total = median(times.total);
  fmt::print("the whole library, ms (median of {})\n", repetitions);
  fmt::print("  parse and check, all dimensions {:8.2f}\n", median(times.check));
  for (int n = 1; n <= 3; ++n) {
    fmt::print("  compile, dimension {}            {:8.2f}\n", n, median(times.compile[n - 1]));
  }
  fmt::print("  parse, check and compile        {:8.2f}   bar {:.0f} {}, aim {:.0f} {}\n", total, kBar,
             total <= kBar ? "pass" : "MISS", kAim, total <= kAim ? "reached" : "not reached");
  fmt::print("  the same the first time         {:8.2f}\n", first);
  return must_pass && total > kBar ? 1 : 0;
}
