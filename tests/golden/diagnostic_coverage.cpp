// SPDX-License-Identifier: MIT
#include "golden/diagnostic_coverage.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <fstream>
#include <map>
#include <ostream>
#include <set>
#include <sstream>
#include <string>

#include "support/diagnostic.h"

namespace gmsim::golden {
namespace {

namespace fs = std::filesystem;

/// The kinds that end the first lines of the messages in an .err file.
void collect_kinds(const fs::path& file, std::set<std::string>& kinds) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const bool message = line.starts_with("error: ") || line.starts_with("warning: ");
    const std::size_t open = line.rfind('[');
    if (message && open != std::string::npos && line.ends_with(']'))
      kinds.insert(line.substr(open + 1, line.size() - open - 2));
  }
}

std::set<std::string> covered_kinds(const fs::path& root) {
  std::set<std::string> kinds;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root))
    if (entry.path().extension() == ".err") collect_kinds(entry.path(), kinds);
  return kinds;
}

/// Exceptions by kind, with their reasons.
std::map<std::string, std::string> read_exceptions(const fs::path& file) {
  std::map<std::string, std::string> exceptions;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string kind;
    std::string reason;
    if (!(words >> kind) || kind.starts_with('#')) continue;
    std::getline(words >> std::ws, reason);
    exceptions[kind] = reason;
  }
  return exceptions;
}

}  // namespace

bool check_coverage(const fs::path& root, std::ostream& report) {
  const fs::path list = root / "uncovered_kinds.txt";
  const std::set<std::string> covered = covered_kinds(root);
  std::map<std::string, std::string> exceptions = read_exceptions(list);
  std::size_t complaints = 0;
  const auto complain = [&](std::string_view kind, std::string_view what) {
    ++complaints;
    fmt::print(report, "[{}] {}\n", kind, what);
  };
  for (const support::DiagnosticKindInfo& row : support::diagnostic_kinds()) {
    const std::string kind(row.name);
    const auto exception = exceptions.extract(kind);
    if (exception.empty() && !covered.contains(kind)) complain(kind, "is in no .err file");
    if (exception.empty()) continue;
    if (covered.contains(kind)) complain(kind, "is covered; take it from uncovered_kinds.txt");
    if (exception.mapped().empty())
      complain(kind, "stands in uncovered_kinds.txt without a reason");
  }
  for (const auto& [kind, reason] : exceptions) complain(kind, "is no kind of diagnostic");
  return complaints == 0;
}

}  // namespace gmsim::golden
