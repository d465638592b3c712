// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <ostream>
#include <string>

#include "cli/commands.h"
#include "cli/run_cli.h"
#include "syntax/parse.h"

namespace gmsim::cli {
namespace {

/// Warnings alone still leave the files accepted.
void report_accepted(Session& session, const check::CheckedRules& rules) {
  std::size_t items = 0;
  for (const syntax::RuleFile& file : rules.files()) {
    const std::string& name = session.sources.name(file.file);
    const auto& asked = session.options.files;
    if (std::find(asked.begin(), asked.end(), name) != asked.end()) items += file.items.size();
  }
  session.out << fmt::format("{} file{} checked, {} item{}: no errors\n", session.options.files.size(),
                             session.options.files.size() == 1 ? "" : "s", items,
                             items == 1 ? "" : "s");
}

}  // namespace

int run_check(Session& session) {
  const check::CheckedRules rules = session.check_rules();
  const int code = session.finish();
  if (code == kDone) report_accepted(session, rules);
  return code;
}

}  // namespace gmsim::cli
