// SPDX-License-Identifier: MIT
#include "cli/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "cli/run_cli.h"

namespace gmsim::cli {

using support::DiagnosticKind;

Session::Session(const Options& options_in, std::ostream& out_in, std::ostream& err_in)
    : options(options_in), out(out_in), err(err_in), trace(err_in) {
  for (const std::string& filter : options.run.traces)
    if (!trace.enable(filter))
      diagnostics.report(
          {.kind = DiagnosticKind::Usage,
           .message = fmt::format("there is no phase to trace in `{}`", filter),
           .help = "phases are parse, check, compile, match, kernel, rewrite and step"});
}

check::CheckedRules Session::check_rules(const std::vector<std::string>& files) {
  check::LibraryOptions library;
  library.stdlib_folder = options.stdlib_folder;
  const std::vector<std::filesystem::path> paths(files.begin(), files.end());
  return check::check_rules(paths, library, sources, diagnostics);
}

void Session::print_warnings() {
  support::render(diagnostics, sources, err);
  diagnostics.rewind(0);
}

int Session::finish() {
  support::render(diagnostics, sources, err);
  if (!diagnostics.has_errors()) return kDone;
  const auto& all = diagnostics.all();
  const bool only_files = std::all_of(all.begin(), all.end(), [](const auto& diagnostic) {
    return diagnostic.severity == support::Severity::Warning ||
           diagnostic.kind == DiagnosticKind::FileError;
  });
  return only_files ? kInputOutput : kRejected;
}

std::optional<support::FileId> Session::read(const std::string& path) {
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.is_open() || stream.bad()) {
    diagnostics.report({.kind = DiagnosticKind::FileError,
                        .message = fmt::format("cannot read `{}`: {}", path, std::strerror(errno))});
    return std::nullopt;
  }
  return sources.add(path, std::move(text));
}

}  // namespace gmsim::cli
