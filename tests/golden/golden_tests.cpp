// SPDX-License-Identifier: MIT
// Runs the cases of tests/golden/ and compares what gmsim prints with what is expected of it.
//   golden_tests [AREA | AREA/NAME]…             compare
//   golden_tests --update [AREA | AREA/NAME]…    rewrite the expectations; review them as a diff
//   golden_tests --coverage                      is every kind of diagnostic expected somewhere?
#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "cli/run_cli.h"
#include "golden/diagnostic_coverage.h"
#include "golden/golden_run.h"

namespace {

using namespace gmsim::golden;

const std::filesystem::path kRoot = "tests/golden";

int run_cases(const std::vector<std::string>& filters, Mode mode) {
  const std::vector<Case> cases = find_cases(kRoot, filters);
  std::size_t failed = 0;
  for (const Case& which : cases)
    if (!run_case(which, gmsim::cli::run_cli, mode, std::cout)) ++failed;
  for (const std::filesystem::path& orphan : find_orphans(kRoot)) {
    ++failed;
    std::cout << orphan.generic_string() << ": belongs to no case\n";
  }
  std::cout << fmt::format("golden: {} cases, {} failed\n", cases.size(), failed);
  return failed > 0 || cases.empty() ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::filesystem::current_path(GMSIM_SOURCE_DIR);  // paths in the expectations start there
  std::vector<std::string> filters(argv + 1, argv + argc);
  if (!filters.empty() && filters.front() == "--coverage")
    return check_coverage(kRoot, std::cout) ? 0 : 1;
  const bool update = !filters.empty() && filters.front() == "--update";
  if (update) filters.erase(filters.begin());
  return run_cases(filters, update ? Mode::Update : Mode::Compare);
}
