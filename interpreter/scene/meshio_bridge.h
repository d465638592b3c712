// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "scene/file_mesh.h"

namespace gmsim::scene {

/// Reads a mesh of any format that meshio (https://pypi.org/project/meshio, MIT) knows: it converts
/// the file into a temporary .msh, or .obj when there are polygons, in a process of its own. The
/// interpreter is `python` when given, otherwise the first that has meshio of: the environment
/// variable GMSIM_PYTHON, `python3`, the virtual environment of gmsim's build folder. Cell sets and
/// the cell tags of Medit, Abaqus and others become regions. Errors are reported.
[[nodiscard]] std::optional<FileMesh> read_through_meshio(const std::filesystem::path& path,
                                                          const std::string& python,
                                                          support::Diagnostics& diagnostics);

}  // namespace gmsim::scene
