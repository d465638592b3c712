// SPDX-License-Identifier: MIT
// Entities, nodes and elements of MSH 4.1, whose text and binary forms hold the same numbers in the
// same order.
#include <fmt/format.h>

#include "scene/msh_state.h"

namespace gmsim::scene {

namespace {

MshState::EntityGroups read_groups(MshState& state) {
  const std::uint64_t count = state.in.size("the number of physical groups of an entity");
  state.in.expect_room(count, {.integers = 1}, "physical groups");
  MshState::EntityGroups groups{.several = count > 1};
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::int32_t group = state.group_number(state.in.integer("a physical group"));
    if (i == 0) groups.first = group;
  }
  return groups;
}

void read_entity(MshState& state, std::int32_t dimension) {
  const std::int32_t tag = state.in.integer("the tag of an entity");
  const int box = dimension == 0 ? 3 : 6;
  for (int i = 0; i < box; ++i) state.in.real("the bounding box of an entity");
  state.groups_of_entity[{dimension, tag}] = read_groups(state);
  if (dimension == 0) return;
  const std::uint64_t bounding = state.in.size("the number of bounding entities");
  state.in.expect_room(bounding, {.integers = 1}, "bounding entities");
  for (std::uint64_t i = 0; i < bounding; ++i) state.in.integer("a bounding entity");
}

struct BlockHeader {
  std::int32_t dimension;
  std::int32_t entity;
};

BlockHeader read_block_header(MshState& state) {
  BlockHeader block{};
  block.dimension = state.in.integer("the dimension of an entity");
  if (block.dimension < 0 || block.dimension > 3) {
    state.in.fail(fmt::format("an entity of dimension {}", block.dimension));
  }
  block.entity = state.in.integer("the tag of an entity");
  return block;
}

/// Returns the number of blocks and of rows in all.
std::pair<std::uint64_t, std::uint64_t> read_counts(MshState& state, std::string_view what) {
  const std::uint64_t blocks = state.in.size("the number of entity blocks");
  state.in.expect_room(blocks, {.integers = 3, .sizes = 1}, "entity blocks");
  const std::uint64_t rows = state.in.size(what);
  state.in.size("the smallest tag");
  state.in.size("the largest tag");
  return {blocks, rows};
}

std::uint64_t read_node_block(MshState& state) {
  const BlockHeader block = read_block_header(state);
  const std::int32_t parametric = state.in.integer("the parametric flag");
  if (parametric != 0 && parametric != 1) {
    state.in.fail(fmt::format("the parametric flag must be 0 or 1, not {}", parametric));
  }
  const int parameters = parametric == 1 ? block.dimension : 0;
  const std::uint64_t count = state.in.size("the number of nodes of a block");
  state.in.expect_room(count, {.sizes = 1, .reals = 3}, "nodes");
  std::vector<std::uint64_t> tags(count);
  for (std::uint64_t& tag : tags) tag = state.in.size("the tag of a node");
  for (std::uint64_t tag : tags) {
    std::array<double, 3> position;
    for (double& coordinate : position) coordinate = state.in.real("a coordinate");
    for (int i = 0; i < parameters; ++i) state.in.real("a parametric coordinate");
    state.add_point(tag, position);
  }
  return count;
}

std::uint64_t read_element_block(MshState& state) {
  const BlockHeader block = read_block_header(state);
  const MshElement& element = state.element(state.in.integer("the type of elements"));
  const std::uint64_t count = state.in.size("the number of elements of a block");
  state.in.expect_room(count, {.sizes = 1 + element.corners}, "elements");
  const auto found = state.groups_of_entity.find({block.dimension, block.entity});
  const auto groups =
      found == state.groups_of_entity.end() ? MshState::EntityGroups{} : found->second;
  if (groups.several && element.kind) state.cells_in_several_groups += count;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t tag = state.in.size("the tag of an element");
    for (std::uint32_t k = 0; k < element.corners; ++k) {
      const std::uint64_t node = state.in.size("a node of an element");
      state.mesh.corners.push_back(state.corner(node, tag));
    }
    state.close_cell(element, tag, groups.first);
  }
  return count;
}

}  // namespace

void read_msh_entities_4(MshState& state) {
  std::array<std::uint64_t, 4> counts;
  for (std::uint64_t& count : counts) {
    count = state.in.size("the number of entities");
    state.in.expect_room(count, {.integers = 1, .sizes = 1, .reals = 3}, "entities");
  }
  for (std::int32_t dimension = 0; dimension < 4; ++dimension) {
    for (std::uint64_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
      read_entity(state, dimension);
    }
  }
}

void read_msh_nodes_4(MshState& state) {
  const auto [blocks, rows] = read_counts(state, "the number of nodes");
  std::uint64_t read = 0;
  for (std::uint64_t i = 0; i < blocks; ++i) read += read_node_block(state);
  if (read != rows) state.in.fail(fmt::format("{} nodes announced, {} given", rows, read));
}

void read_msh_elements_4(MshState& state) {
  const auto [blocks, rows] = read_counts(state, "the number of elements");
  std::uint64_t read = 0;
  for (std::uint64_t i = 0; i < blocks; ++i) read += read_element_block(state);
  if (read != rows) state.in.fail(fmt::format("{} elements announced, {} given", rows, read));
}

}  // namespace gmsim::scene
