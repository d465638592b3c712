// SPDX-License-Identifier: MIT
#include "scene/msh_state.h"

#include <fmt/format.h>

#include <limits>

namespace gmsim::scene {

void MshState::add_point(std::uint64_t tag, const std::array<double, 3>& position) {
  const auto number = static_cast<std::uint32_t>(mesh.points.size());
  if (!point_of_tag.emplace(tag, number).second) {
    in.fail(fmt::format("node {} is given a second time", tag));
  }
  mesh.points.push_back(position);
}

const MshElement& MshState::element(std::int32_t type) {
  const MshElement* found = find_msh_element(type);
  if (found == nullptr) in.fail(fmt::format("element type {} is unknown", type));
  if (!found->linear()) {
    in.fail(
        fmt::format("a {} (element type {}) cannot be read, only linear cells can; `gmsh FILE "
                    "-order 1 -save -o NEW.msh` makes them linear",
                    found->name, type));
  }
  return *found;
}

std::uint32_t MshState::corner(std::uint64_t node_tag, std::uint64_t cell_tag) {
  const auto found = point_of_tag.find(node_tag);
  if (found == point_of_tag.end()) {
    in.fail(fmt::format("element {} has node {}, which does not exist", cell_tag, node_tag));
  }
  return found->second;
}

void MshState::close_cell(const MshElement& element, std::uint64_t tag, std::int32_t group) {
  if (!element.kind) {
    ++mesh.point_cells;
    mesh.corners.resize(mesh.begin.back());
    return;
  }
  cell_of_tag.emplace(tag, mesh.cell_count());
  mesh.close_cell(*element.kind, group);
}

std::int32_t MshState::group_number(std::int32_t physical) {
  if (physical == std::numeric_limits<std::int32_t>::min()) {
    in.fail(fmt::format("physical group {} is out of range", physical));
  }
  return physical < 0 ? -physical : physical;
}

}  // namespace gmsim::scene
