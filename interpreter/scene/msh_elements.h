// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "scene/file_mesh.h"

namespace gmsim::scene {

/// One element type of Gmsh.
struct MshElement {
  std::int32_t type;
  std::string_view name;
  std::uint32_t corners;         ///< 0 for the types that are not read
  std::optional<CellKind> kind;  ///< empty for points, and for the types that are not read

  [[nodiscard]] bool linear() const { return corners > 0; }
};

/// Null for numbers that Gmsh does not use. Gmsh and VTK order the corners of linear cells alike.
[[nodiscard]] const MshElement* find_msh_element(std::int32_t type);

}  // namespace gmsim::scene
