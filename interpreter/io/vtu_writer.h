// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "io/mesh_frame.h"
#include "support/diagnostic.h"

namespace gmsim::io {

/// A mesh as a VTK XML unstructured grid (.vtu): file version 1.0, arrays as inline base64 without
/// compression, little endian with 64-bit lengths; polyhedra as `faces` and `faceoffsets`. Read by
/// every VTK since 6, ParaView, VisIt and meshio (which knows no polyhedra beside other cells).
[[nodiscard]] std::string vtu_text(const MeshFrame& frame);

/// False after an error, which is reported as file-error.
bool write_vtu(const std::filesystem::path& path, const MeshFrame& frame,
               support::Diagnostics& diagnostics);

}  // namespace gmsim::io
