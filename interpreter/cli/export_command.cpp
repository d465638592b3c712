// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <ostream>

#include "cli/commands.h"
#include "cli/run_cli.h"
#include "io/export_trajectory.h"
#include "io/html_view.h"
#include "io/text_file.h"

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

int run_view(Session& session) {
  const FileOptions& options = session.options.file;
  const auto reader = io::TrajectoryReader::open(options.file, session.diagnostics);
  if (!reader) return session.finish();
  const std::string name = run_name(options.file);
  const auto view = io::html_view(
      *reader, {options.frames, options.field, options.title.empty() ? name : options.title},
      session.diagnostics);
  const auto page = options.output.empty() ? std::filesystem::path(name + ".html") : options.output;
  if (view && io::write_file(page, view->text, session.diagnostics))
    session.out << fmt::format("wrote {}: {} frame{}, {:.1f} MB; open it in a browser\n",
                               page.string(), view->frames, view->frames == 1 ? "" : "s",
                               static_cast<double>(view->text.size()) / 1e6);
  return session.finish();
}

}  // namespace gmsim::cli
