// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <span>
#include <unordered_map>

#include "scene/file_mesh.h"
#include "scene/mesh_bytes.h"
#include "scene/msh_elements.h"

namespace gmsim::scene {

enum class MshVersion { Unknown, One, Two, Four };

/// What the sections of a Gmsh file read so far have told.
struct MshState {
  explicit MshState(std::string_view bytes) : in(bytes) {}

  MeshBytes in;
  MshVersion version = MshVersion::Unknown;
  FileMesh mesh;
  std::unordered_map<std::uint64_t, std::uint32_t> point_of_tag;
  std::unordered_map<std::uint64_t, std::size_t> cell_of_tag;
  /// Version 4: the physical groups of an entity (dimension, tag).
  struct EntityGroups {
    std::int32_t first = 0;
    bool several = false;
  };
  std::map<std::pair<std::int32_t, std::int32_t>, EntityGroups> groups_of_entity;
  std::size_t cells_in_several_groups = 0;
  bool has_points = false, has_cells = false;

  void add_point(std::uint64_t tag, const std::array<double, 3>& position);
  /// The element type, which must be one that is read.
  const MshElement& element(std::int32_t type);
  /// The point with this tag, as the corner of a cell.
  std::uint32_t corner(std::uint64_t node_tag, std::uint64_t cell_tag);
  /// Ends the cell whose corners were appended to mesh.corners.
  void close_cell(const MshElement& element, std::uint64_t tag, std::int32_t group);
  /// The number of a physical group; Gmsh marks turned orientation by a minus sign.
  std::int32_t group_number(std::int32_t physical);
};

// One function per section; each starts behind the section's name.
void read_msh_nodes_1_2(MshState& state);
void read_msh_elements_1(MshState& state);
void read_msh_elements_2(MshState& state);
void read_msh_entities_4(MshState& state);
void read_msh_nodes_4(MshState& state);
void read_msh_elements_4(MshState& state);
enum class MshDataPlace { Nodes, Elements };
void read_msh_data(MshState& state, MshDataPlace place);

}  // namespace gmsim::scene
