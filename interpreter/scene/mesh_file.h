// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "scene/file_mesh.h"

namespace gmsim::scene {

/// Reads a .msh or .obj file, by its extension; `name` stands for it in messages.
[[nodiscard]] std::optional<FileMesh> read_mesh_file(const std::filesystem::path& path,
                                                     const std::string& name,
                                                     support::Diagnostics& diagnostics);
/// True for the extensions that read_mesh_file knows.
[[nodiscard]] bool reads_itself(const std::filesystem::path& path);

}  // namespace gmsim::scene
