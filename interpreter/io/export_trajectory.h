// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "io/trajectory_reader.h"
#include "support/diagnostic.h"

namespace gmsim::io {

enum class ExportFormat {
  Pvd,  ///< NAME.pvd with the times, and NAME_0000.vtu … : ParaView of any age, VisIt, meshio
  Obj,  ///< NAME_0000.obj … : the visible surface of each frame
  Usd   ///< NAME.usda: the moving surface in one file, for Blender
};
/// "pvd", "obj", "usd"; nothing for other names.
[[nodiscard]] std::optional<ExportFormat> find_export_format(std::string_view name);

struct ExportOptions {
  ExportFormat format = ExportFormat::Pvd;
  std::int64_t first = 0;  ///< frame to begin with; negative: from the end, -1 is the last
  std::int64_t last = -1;  ///< frame to end with, included; negative likewise
  std::int64_t every = 1;  ///< 2: every second frame
};

/// Writes frames to `folder`, which is made if it does not exist. `name` begins the names of the
/// files. Returns the files that were written, the one to open first; nothing after an error
/// (usage: no such frames; file-error).
[[nodiscard]] std::optional<std::vector<std::filesystem::path>> export_trajectory(
    const TrajectoryReader& reader, const std::filesystem::path& folder, std::string_view name,
    const ExportOptions& options, support::Diagnostics& diagnostics);

}  // namespace gmsim::io
