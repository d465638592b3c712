// SPDX-License-Identifier: MIT
#include "cli/run_cli.h"

#include <exception>
#include <ostream>

#include "cli/commands.h"
#include "cli/options.h"

namespace gmsim::cli {
namespace {

int refuse_scene(Session& session) {
  session.diagnostics.report(
      {.kind = support::DiagnosticKind::Usage,
       .message = "this version does not run scenes yet",
       .help = "it checks rule files and applies rules to meshes: `gmsim -h` shows how"});
  return session.finish();
}

int run_command(Session& session) {
  using Command = Options::Command;
  switch (session.options.command) {
    case Command::Check: return run_check(session);
    case Command::List: return run_list(session);
    case Command::Dump: return run_dump(session);
    case Command::Apply: return run_apply(session);
    case Command::Fuzz: return run_fuzz(session);
    case Command::Info: return run_info(session);
    case Command::Export: return run_export(session);
    case Command::Recover: return run_recover(session);
    case Command::Snapshot: return run_snapshot(session);
    case Command::Run:
    case Command::Verify:
    case Command::Explain:
    case Command::Study: return refuse_scene(session);
    case Command::None: break;
  }
  return kRejected;
}

}  // namespace

int run_cli(std::span<const std::string> arguments, std::ostream& out, std::ostream& err) {
  try {
    const ParsedOptions parsed = parse_options(arguments, out, err);
    if (parsed.exit_code) return *parsed.exit_code;
    Session session(parsed.options, out, err);
    if (session.diagnostics.has_errors()) return session.finish();
    return run_command(session);
  } catch (const std::exception& error) {
    err << "internal error: " << error.what() << '\n'
        << "help: this is a bug of gmsim; please report it with the command and its files\n";
    return kInternalError;
  }
}

}  // namespace gmsim::cli
