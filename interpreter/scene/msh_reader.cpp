// SPDX-License-Identifier: MIT
// The sections of a Gmsh file, in whatever order they come.
#include <fmt/format.h>

#include <bit>

#include "scene/msh_state.h"

namespace gmsim::scene {

namespace {

void set_version(MshState& state, std::string_view version) {
  if (version == "4.1") {
    state.version = MshVersion::Four;
  } else if (version == "2" || version.starts_with("2.")) {
    state.version = MshVersion::Two;
  } else {
    state.in.fail(
        fmt::format("version {} of the format cannot be read; 1, 2.x and 4.1 can: `gmsh FILE -save "
                    "-format msh41 -o NEW.msh`",
                    shown(version)));
  }
}

void read_format(MshState& state) {
  MeshBytes& in = state.in;
  if (state.version != MshVersion::Unknown) in.fail("a second $MeshFormat section");
  set_version(state, in.word("the version of the format"));
  const std::int64_t file_type = in.text_integer("the file type");
  if (file_type != 0 && file_type != 1) in.fail("the file type must be 0 (text) or 1 (binary)");
  const std::int64_t size_bytes = in.text_integer("the data size");
  if (size_bytes != 8 && (size_bytes != 4 || state.version == MshVersion::Two)) {
    in.fail(fmt::format("data size {} cannot be read", size_bytes));
  }
  if (file_type == 0) return;
  in.rest_of_line();
  in.set_binary(true, static_cast<int>(size_bytes));
  const std::int32_t one = in.integer("the number 1 that shows the byte order");
  constexpr std::int32_t kOneSwapped = 0x01000000;
  if (one == kOneSwapped) in.swap_bytes();
  if (one != 1 && one != kOneSwapped) in.fail("the number that shows the byte order is not 1");
}

void read_physical_names(MshState& state) {
  const std::int64_t count = state.in.text_integer("the number of physical names");
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t dimension = state.in.text_integer("the dimension of a group");
    const std::int64_t number = state.in.text_integer("the number of a group");
    const std::string_view name = state.in.quoted("the name of a group");
    if (dimension < 0 || dimension > 3)
      state.in.fail(fmt::format("a group of dimension {}", dimension));
    if (number < 0 || number > std::numeric_limits<std::int32_t>::max()) {
      state.in.fail(fmt::format("group number {} is out of range", number));
    }
    state.mesh.region_names[{static_cast<int>(dimension), static_cast<std::int32_t>(number)}] =
        name;
  }
}

/// Sections of a binary file begin behind the end of the line that names them.
void to_rows(MshState& state) {
  if (state.version == MshVersion::Four && state.in.binary()) state.in.rest_of_line();
}

void read_nodes(MshState& state) {
  if (state.has_points) state.in.fail("a second section of nodes");
  state.has_points = true;
  to_rows(state);
  if (state.version == MshVersion::Four) {
    read_msh_nodes_4(state);
  } else {
    read_msh_nodes_1_2(state);
  }
}

void read_elements(MshState& state) {
  if (state.has_cells) state.in.fail("a second section of elements");
  if (!state.has_points) state.in.fail("elements before the nodes they are made of");
  state.has_cells = true;
  to_rows(state);
  switch (state.version) {
    case MshVersion::One:
      read_msh_elements_1(state);
      break;
    case MshVersion::Two:
      read_msh_elements_2(state);
      break;
    case MshVersion::Four:
      read_msh_elements_4(state);
      break;
    case MshVersion::Unknown:
      break;
  }
}

/// False when the section is one that is passed over.
bool read_section(MshState& state, std::string_view name) {
  if (name == "NOD" || name == "ELM") {
    if (state.version != MshVersion::Unknown && state.version != MshVersion::One) {
      state.in.fail(fmt::format("${} belongs to version 1 of the format", name));
    }
    state.version = MshVersion::One;
    name == "NOD" ? read_nodes(state) : read_elements(state);
    return true;
  }
  if (name == "MeshFormat") {
    read_format(state);
    return true;
  }
  if (state.version == MshVersion::Unknown) {
    state.in.fail(fmt::format("${} before $MeshFormat", shown(name)));
  }
  if (name == "PhysicalNames") {
    read_physical_names(state);
  } else if (name == "Nodes") {
    read_nodes(state);
  } else if (name == "Elements") {
    read_elements(state);
  } else if (name == "Entities" && state.version == MshVersion::Four) {
    to_rows(state);
    read_msh_entities_4(state);
  } else if (name == "PartitionedEntities") {
    state.in.fail("partitioned meshes cannot be read; save the mesh without partitions");
  } else if (name == "ParametricNodes") {
    state.in.fail("parametric nodes cannot be read; save the mesh with Mesh.SaveParametric = 0");
  } else if (name == "NodeData" || name == "ElementData") {
    read_msh_data(state, name == "NodeData" ? MshDataPlace::Nodes : MshDataPlace::Elements);
  } else {
    return false;
  }
  return true;
}

void read_any_section(MshState& state, std::string_view word) {
  if (word.size() < 2 || word[0] != '$') {
    state.in.fail(fmt::format("`{}` where a section such as $Nodes is expected", shown(word)));
  }
  const std::string_view name = word.substr(1);
  const std::string end =
      fmt::format("{}{}", name == "NOD" || name == "ELM" ? "$END" : "$End", name);
  if (!read_section(state, name)) {
    const std::size_t found = state.in.find(end);
    if (found == std::string_view::npos)
      state.in.fail(fmt::format("section {} never ends", shown(word)));
    state.in.seek(found);
  }
  const std::string_view last = state.in.word(end);
  if (last != end) state.in.fail(fmt::format("`{}` where {} is expected", shown(last), shown(end)));
}

}  // namespace

FileMesh read_msh(std::string_view bytes) {
  MshState state(bytes);
  for (state.in.skip_space(); !state.in.at_end(); state.in.skip_space()) {
    read_any_section(state, state.in.word("a section"));
  }
  if (!state.has_cells) state.in.fail("the file has no elements");
  if (state.cells_in_several_groups > 0) {
    state.mesh.warnings.push_back(
        fmt::format("{} cells are in several physical groups; each keeps the first",
                    state.cells_in_several_groups));
  }
  return std::move(state.mesh);
}

}  // namespace gmsim::scene
