// SPDX-License-Identifier: MIT
#include "cli/run_cli.h"

#include <exception>
#include <ostream>

#include "cli/commands.h"
#include "cli/options.h"

namespace gmsim::cli {
namespace {

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
    case Command::View: return run_view(session);
    case Command::Run: return run_scene(session);
    case Command::Verify: return run_verify(session);
    case Command::Explain: return run_explain(session);
    case Command::Study: return run_study(session);
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
