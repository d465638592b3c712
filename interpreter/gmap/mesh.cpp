// SPDX-License-Identifier: MIT
#include "gmap/mesh.h"

#include <algorithm>

namespace gmsim::gmap {

void Mesh::add_cell(CellKind kind, const std::vector<std::uint32_t>& corners) {
  cell_points.insert(cell_points.end(), corners.begin(), corners.end());
  cell_begin.push_back(static_cast<std::uint32_t>(cell_points.size()));
  kinds.push_back(kind);
}

bool MeshMap::failed() const {
  return std::any_of(problems.begin(), problems.end(),
                     [](const MeshProblem& problem) { return problem.fatal; });
}

}  // namespace gmsim::gmap
