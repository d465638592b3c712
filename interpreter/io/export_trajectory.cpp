// SPDX-License-Identifier: MIT
#include "io/export_trajectory.h"

#include <fmt/format.h>

#include <utility>

#include "io/obj_writer.h"
#include "io/text_file.h"
#include "io/usd_writer.h"
#include "io/vtu_writer.h"

namespace gmsim::io {

namespace {

using support::DiagnosticKind;
using support::Diagnostics;
using Files = std::vector<std::filesystem::path>;

/// The numbers of the frames to export; nothing, and an error, when there are none.
std::optional<std::vector<std::int64_t>> chosen_frames(const TrajectoryReader& reader,
                                                       const ExportOptions& options,
                                                       Diagnostics& diagnostics) {
  const std::int64_t count = reader.summary().frames;
  const std::int64_t first = options.first < 0 ? count + options.first : options.first;
  const std::int64_t last = options.last < 0 ? count + options.last : options.last;
  if (first < 0 || last >= count || first > last || options.every < 1) {
    diagnostics.report(
        {.kind = DiagnosticKind::Usage,
         .message = fmt::format("there are no frames from {} to {} by {}; the file has 0 to {}",
                                options.first, options.last, options.every, count - 1)});
    return std::nullopt;
  }
  std::vector<std::int64_t> frames;
  for (std::int64_t frame = first; frame <= last; frame += options.every) frames.push_back(frame);
  return frames;
}

bool make_folder(const std::filesystem::path& folder, Diagnostics& diagnostics) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error) return true;
  diagnostics.report({.kind = DiagnosticKind::FileError,
                      .message = fmt::format("{}: the folder cannot be made: {}", folder.string(),
                                             error.message())});
  return false;
}

std::string pvd_text(const Files& files, const std::vector<double>& times) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n"
      "<Collection>\n";
  for (std::size_t i = 0; i < files.size(); ++i) {
    text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", times[i],
                        xml_escaped(files[i].filename().string()));
  }
  return text + "</Collection>\n</VTKFile>\n";
}

std::optional<Files> export_files(const TrajectoryReader& reader,
                                  const std::filesystem::path& folder, std::string_view name,
                                  ExportFormat format, const std::vector<std::int64_t>& frames,
                                  Diagnostics& diagnostics) {
  Files files;
  std::vector<double> times;
  for (std::int64_t frame : frames) {
    const bool is_vtu = format == ExportFormat::Pvd;
    const auto mesh = reader.read_frame(frame, is_vtu, diagnostics);
    if (!mesh) return std::nullopt;
    files.push_back(folder / fmt::format("{}_{:04}.{}", name, frame, is_vtu ? "vtu" : "obj"));
    times.push_back(*mesh->time);
    const bool written = is_vtu ? write_vtu(files.back(), *mesh, diagnostics)
                                : write_obj(files.back(), *mesh, diagnostics);
    if (!written) return std::nullopt;
  }
  if (format != ExportFormat::Pvd) return files;
  const auto index = folder / fmt::format("{}.pvd", name);
  if (!write_file(index, pvd_text(files, times), diagnostics)) return std::nullopt;
  files.insert(files.begin(), index);
  return files;
}

std::optional<Files> export_usd(const TrajectoryReader& reader, const std::filesystem::path& folder,
                                std::string_view name, const std::vector<std::int64_t>& frames,
                                Diagnostics& diagnostics) {
  UsdText text;
  std::int64_t epoch = -1;
  for (std::int64_t frame : frames) {
    const auto mesh = reader.read_frame(frame, false, diagnostics);
    if (!mesh) return std::nullopt;
    const std::int64_t now = reader.epoch_of()[static_cast<std::size_t>(frame)];
    text.add_frame(*mesh, now != std::exchange(epoch, now));
  }
  const auto path = folder / fmt::format("{}.usda", name);
  if (!write_file(path, text.finish(), diagnostics)) return std::nullopt;
  return Files{path};
}

}  // namespace

std::optional<ExportFormat> find_export_format(std::string_view name) {
  if (name == "pvd") return ExportFormat::Pvd;
  if (name == "obj") return ExportFormat::Obj;
  if (name == "usd") return ExportFormat::Usd;
  return std::nullopt;
}

std::optional<Files> export_trajectory(const TrajectoryReader& reader,
                                       const std::filesystem::path& folder, std::string_view name,
                                       const ExportOptions& options, Diagnostics& diagnostics) {
  const auto frames = chosen_frames(reader, options, diagnostics);
  if (!frames || !make_folder(folder, diagnostics)) return std::nullopt;
  if (options.format == ExportFormat::Usd)
    return export_usd(reader, folder, name, *frames, diagnostics);
  return export_files(reader, folder, name, options.format, *frames, diagnostics);
}

}  // namespace gmsim::io
