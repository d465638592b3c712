// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <ostream>

#include "cli/commands.h"
#include "cli/run_cli.h"
#include "io/recover.h"

namespace gmsim::cli {
namespace {

/// A file that is there already is somebody's run.
bool may_write(Session& session, const std::filesystem::path& target) {
  std::error_code error;
  if (session.options.file.force || !std::filesystem::exists(target, error)) return true;
  session.diagnostics.report(
      {.kind = support::DiagnosticKind::FileError,
       .message = fmt::format("{} is there already", target.string()),
       .help = "choose another name with `-o`, or write over it with `--force`"});
  return false;
}

int copy_finished_frames(Session& session, const std::filesystem::path& target) {
  const std::filesystem::path& source = session.options.file.file;
  if (!may_write(session, target)) return session.finish();
  if (const auto frames = io::recover(source, target, session.diagnostics))
    session.out << fmt::format("{}: {} frame{} of {}\n", target.string(), *frames,
                               *frames == 1 ? "" : "s", source.string());
  return session.finish();
}

}  // namespace

int run_recover(Session& session) {
  const FileOptions& options = session.options.file;
  return copy_finished_frames(
      session, options.output.empty() ? io::recovered_path(options.file) : options.output);
}

int run_snapshot(Session& session) {
  return copy_finished_frames(session, session.options.file.output);
}

}  // namespace gmsim::cli
