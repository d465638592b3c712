// SPDX-License-Identifier: MIT
// Nodes and elements of MSH 1 ($NOD, $ELM) and MSH 2. Counts are text in both; the rows of MSH 2
// may be binary, its elements then in runs of one type.
#include <fmt/format.h>

#include <algorithm>

#include "scene/msh_state.h"

namespace gmsim::scene {

namespace {

/// Rows follow a text line that holds their number.
std::uint64_t row_count(MshState& state, std::string_view what) {
  const std::int64_t count = state.in.text_integer(what);
  if (count < 0) state.in.fail(fmt::format("{} is negative: {}", what, count));
  if (state.in.binary()) state.in.rest_of_line();
  return static_cast<std::uint64_t>(count);
}

std::uint64_t tag(MshState& state, std::string_view what) {
  const std::int32_t value = state.in.integer(what);
  if (value < 0) state.in.fail(fmt::format("{} is negative: {}", what, value));
  return static_cast<std::uint64_t>(value);
}

/// Where an element of these versions says it belongs.
struct Membership {
  std::int32_t group = 0;
  std::int32_t entity = 0;  ///< 0: not given
};

/// These versions repeat an element, under a new number, for every further group it is in.
class RepeatedElements {
 public:
  bool repeats(const MshState& state, const MshElement& element, Membership now) {
    const FileMesh& mesh = state.mesh;
    const auto corners = std::span(mesh.corners).subspan(mesh.begin.back());
    const bool same =
        last_element_ == &element && now.entity != 0 && now.entity == last_.entity &&
        now.group != last_.group && mesh.cell_count() > 0 && element.kind &&
        std::equal(
            corners.begin(), corners.end(),
            mesh.corners.begin() + static_cast<std::ptrdiff_t>(mesh.begin[mesh.cell_count() - 1]),
            mesh.corners.begin() + static_cast<std::ptrdiff_t>(mesh.begin.back()));
    if (!same) in_run_ = false;
    last_ = now;
    last_element_ = &element;
    return same;
  }
  /// True once for each repeated element.
  bool first_repetition() { return !std::exchange(in_run_, true); }

 private:
  const MshElement* last_element_ = nullptr;
  Membership last_;
  bool in_run_ = false;
};

void read_corners(MshState& state, const MshElement& element, std::uint64_t cell_tag) {
  for (std::uint32_t i = 0; i < element.corners; ++i) {
    const std::uint64_t node = tag(state, "a node of an element");
    state.mesh.corners.push_back(state.corner(node, cell_tag));
  }
}

void finish(MshState& state, const MshElement& element, std::uint64_t cell_tag,
            Membership membership, RepeatedElements& repeated) {
  if (repeated.repeats(state, element, membership)) {
    state.cell_of_tag.emplace(cell_tag, state.mesh.cell_count() - 1);
    state.mesh.corners.resize(state.mesh.begin.back());
    if (repeated.first_repetition()) ++state.cells_in_several_groups;
    return;
  }
  state.close_cell(element, cell_tag, membership.group);
}

Membership read_tags(MshState& state, std::uint64_t count) {
  Membership membership;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::int32_t value = state.in.integer("a tag of an element");
    if (i == 0) membership.group = state.group_number(value);
    if (i == 1) membership.entity = value;
  }
  return membership;
}

void read_text_element(MshState& state, RepeatedElements& repeated) {
  const std::uint64_t cell_tag = tag(state, "the number of an element");
  const MshElement& element = state.element(state.in.integer("the type of an element"));
  const Membership membership = read_tags(state, tag(state, "the number of tags"));
  read_corners(state, element, cell_tag);
  finish(state, element, cell_tag, membership, repeated);
}

/// A run of elements of one type; returns how many.
std::uint64_t read_binary_run(MshState& state, RepeatedElements& repeated) {
  const MshElement& element = state.element(state.in.integer("the type of elements"));
  const std::uint64_t count = tag(state, "the number of elements of one type");
  const std::uint64_t tags = tag(state, "the number of tags");
  state.in.expect_room(count, {.integers = 1 + tags + element.corners}, "elements");
  if (count == 0) state.in.fail("a run of no elements");
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t cell_tag = tag(state, "the number of an element");
    const Membership membership = read_tags(state, tags);
    read_corners(state, element, cell_tag);
    finish(state, element, cell_tag, membership, repeated);
  }
  return count;
}

}  // namespace

void read_msh_nodes_1_2(MshState& state) {
  const std::uint64_t count = row_count(state, "the number of nodes");
  state.in.expect_room(count, {.integers = 1, .reals = 3}, "nodes");
  state.mesh.points.reserve(count);
  state.point_of_tag.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t node = tag(state, "the number of a node");
    std::array<double, 3> position;
    for (double& coordinate : position) coordinate = state.in.real("a coordinate");
    state.add_point(node, position);
  }
}

void read_msh_elements_1(MshState& state) {
  const std::uint64_t count = row_count(state, "the number of elements");
  state.in.expect_room(count, {.integers = 6}, "elements");
  RepeatedElements repeated;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t cell_tag = tag(state, "the number of an element");
    const MshElement& element = state.element(state.in.integer("the type of an element"));
    Membership membership;
    membership.group = state.group_number(state.in.integer("the physical group of an element"));
    membership.entity = state.in.integer("the entity of an element");
    const std::uint64_t corners = tag(state, "the number of nodes of an element");
    if (corners != element.corners) {
      state.in.fail(
          fmt::format("element {} is a {} with {} nodes", cell_tag, element.name, corners));
    }
    read_corners(state, element, cell_tag);
    finish(state, element, cell_tag, membership, repeated);
  }
}

void read_msh_elements_2(MshState& state) {
  const std::uint64_t count = row_count(state, "the number of elements");
  state.in.expect_room(count, {.integers = 4}, "elements");
  RepeatedElements repeated;
  for (std::uint64_t read = 0; read < count;) {
    if (state.in.binary()) {
      read += read_binary_run(state, repeated);
    } else {
      read_text_element(state, repeated);
      ++read;
    }
  }
}

}  // namespace gmsim::scene
