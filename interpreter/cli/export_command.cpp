// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <ostream>

#include "cli/commands.h"
#include "cli/run_cli.h"
#include "io/export_trajectory.h"

namespace gmsim::cli {
namespace {

/// "run" for run.vtkhdf and for run.vtkhdf.part.
std::string run_name(std::filesystem::path file) {
  if (file.extension() == ".part") file.replace_extension();
  return file.stem().string();
}

}  // namespace

int run_export(Session& session) {
  const FileOptions& options = session.options.file;
  const auto reader = io::TrajectoryReader::open(options.file, session.diagnostics);
  if (!reader) return session.finish();
  const io::ExportOptions wanted{*io::find_export_format(options.format), options.first,
                                 options.last, options.every};
  const auto files = io::export_trajectory(*reader, options.output, run_name(options.file), wanted,
                                           session.diagnostics);
  if (files && !files->empty())
    session.out << fmt::format("wrote {} file{}; open {}\n", files->size(),
                               files->size() == 1 ? "" : "s", files->front().string());
  return session.finish();
}

}  // namespace gmsim::cli
