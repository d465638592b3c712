// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "io/mesh_frame.h"
#include "support/diagnostic.h"

namespace gmsim::io {

/// A mesh as Wavefront .obj: all points under their numbers (from 1 there), the visible surface as
/// faces of any arity, lines as lines. Coordinates are written with all their digits.
[[nodiscard]] std::string obj_text(const MeshFrame& frame);

/// False after an error, which is reported as file-error.
bool write_obj(const std::filesystem::path& path, const MeshFrame& frame,
               support::Diagnostics& diagnostics);

}  // namespace gmsim::io
