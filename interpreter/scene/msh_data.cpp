// SPDX-License-Identifier: MIT
// $NodeData and $ElementData: a head of text lines, then a row (number, values) per node or
// element.
#include <fmt/format.h>

#include "scene/msh_state.h"

namespace gmsim::scene {

namespace {

/// More numbers in a row than any field of mechanics has; a file that asks for more is not read.
constexpr std::int64_t kMostComponents = 64;

std::int64_t head_count(MshState& state, std::string_view what) {
  const std::int64_t count = state.in.text_integer(what);
  if (count < 0) state.in.fail(fmt::format("{} is negative: {}", what, count));
  state.in.expect_room(static_cast<std::uint64_t>(count), {.integers = 1}, what);
  return count;
}

struct Head {
  std::string name;
  std::int64_t components = 0;
  std::int64_t rows = 0;
};

Head read_head(MshState& state) {
  Head head;
  const std::int64_t strings = head_count(state, "the number of string tags");
  for (std::int64_t i = 0; i < strings; ++i) {
    const std::string_view text = state.in.quoted("the name of the data");
    if (i == 0) head.name = text;
  }
  const std::int64_t reals = head_count(state, "the number of real tags");
  for (std::int64_t i = 0; i < reals; ++i) state.in.text_real("a real tag");
  const std::int64_t integers = head_count(state, "the number of integer tags");
  if (integers < 3) state.in.fail("data needs the integer tags step, components and rows");
  for (std::int64_t i = 0; i < integers; ++i) {
    const std::int64_t value = state.in.text_integer("an integer tag");
    if (i == 1) head.components = value;
    if (i == 2) head.rows = value;
  }
  if (head.components < 1 || head.components > kMostComponents) {
    state.in.fail(fmt::format("data `{}` has {} components; 1 to {} can be read", shown(head.name),
                              head.components, kMostComponents));
  }
  if (head.rows < 0) state.in.fail(fmt::format("the number of rows is negative: {}", head.rows));
  if (state.in.binary()) state.in.rest_of_line();
  return head;
}

std::size_t row_of(MshState& state, MshDataPlace place, std::uint64_t tag) {
  if (place == MshDataPlace::Nodes) {
    const auto found = state.point_of_tag.find(tag);
    if (found != state.point_of_tag.end()) return found->second;
    state.in.fail(fmt::format("data for node {}, which does not exist", tag));
  }
  const auto found = state.cell_of_tag.find(tag);
  if (found != state.cell_of_tag.end()) return found->second;
  return state.mesh.cell_count();
}

}  // namespace

void read_msh_data(MshState& state, MshDataPlace place) {
  const Head head = read_head(state);
  const auto components = static_cast<std::uint64_t>(head.components);
  state.in.expect_room(static_cast<std::uint64_t>(head.rows), {.integers = 1, .reals = components},
                       "rows");
  FileColumn column{head.name, static_cast<std::uint32_t>(components), {}, {}};
  for (std::int64_t i = 0; i < head.rows; ++i) {
    const std::int32_t tag = state.in.integer("the number of a row");
    if (tag < 0) state.in.fail(fmt::format("the number of a row is negative: {}", tag));
    const std::size_t row = row_of(state, place, static_cast<std::uint64_t>(tag));
    const bool known = place == MshDataPlace::Nodes || row < state.mesh.cell_count();
    if (known) column.rows.push_back(row);
    for (std::uint64_t k = 0; k < components; ++k) {
      const double value = state.in.real("a value");
      if (known) column.values.push_back(value);
    }
  }
  (place == MshDataPlace::Nodes ? state.mesh.point_data : state.mesh.cell_data)
      .push_back(std::move(column));
}

}  // namespace gmsim::scene
