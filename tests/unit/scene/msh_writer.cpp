// SPDX-License-Identifier: MIT
#include "unit/scene/msh_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>

namespace gmsim::test {

namespace {

int dimension_of(std::int32_t type) {
  static const std::map<std::int32_t, int> kDimensions = {{15, 0}, {1, 1}, {2, 2}, {3, 2},
                                                          {4, 3},  {5, 3}, {6, 3}, {7, 3}};
  return kDimensions.at(type);
}

/// Appends numbers in the form of the file.
class Output {
 public:
  explicit Output(const MshForm& form) : form_(form) {}

  void text(std::string_view words) { out_ += words; }
  void integer(std::int64_t value) {
    if (form_.binary) {
      raw(static_cast<std::int32_t>(value));
    } else {
      out_ += fmt::format("{} ", value);
    }
  }
  void size(std::uint64_t value) {
    if (!form_.binary) {
      out_ += fmt::format("{} ", value);
    } else if (form_.size_bytes == 8) {
      raw(value);
    } else {
      raw(static_cast<std::uint32_t>(value));
    }
  }
  void real(double value) {
    if (form_.binary) {
      raw(value);
    } else {
      out_ += fmt::format("{} ", value);
    }
  }
  void end_row() {
    if (!form_.binary) out_ += "\n";
  }
  void end_section(std::string_view name) { out_ += fmt::format("\n${}\n", name); }
  [[nodiscard]] std::string take() { return std::move(out_); }

 private:
  template <class Number>
  void raw(Number value) {
    std::array<char, sizeof(Number)> bytes;
    std::memcpy(bytes.data(), &value, sizeof(Number));
    if (form_.swapped) std::reverse(bytes.begin(), bytes.end());
    out_.append(bytes.data(), bytes.size());
  }

  MshForm form_;
  std::string out_;
};

void write_head(const MshContent& content, const MshForm& form, Output& out) {
  out.text(
      fmt::format("$MeshFormat\n{} {} {}\n", form.version, form.binary ? 1 : 0, form.size_bytes));
  if (form.binary) out.integer(1);
  out.text(form.binary ? "\n$EndMeshFormat\n" : "$EndMeshFormat\n");
  if (content.groups.empty()) return;
  out.text(fmt::format("$PhysicalNames\n{}\n", content.groups.size()));
  for (const auto& group : content.groups) {
    out.text(fmt::format("{} {} \"{}\"\n", group.dimension, group.number, group.name));
  }
  out.text("$EndPhysicalNames\n");
}

void write_position(const std::array<double, 3>& position, Output& out) {
  for (double coordinate : position) out.real(coordinate);
  out.end_row();
}

void write_nodes_1_2(const MshContent& content, Output& out) {
  out.text(fmt::format("{}\n", content.points.size()));
  for (std::size_t i = 0; i < content.points.size(); ++i) {
    out.integer(static_cast<std::int64_t>(content.point_tags[i]));
    write_position(content.points[i], out);
  }
}

void write_corners_1_2(const MshContent& content, const MshContent::Cell& cell, Output& out) {
  for (std::uint32_t corner : cell.corners) {
    out.integer(static_cast<std::int64_t>(content.point_tags[corner]));
  }
  out.end_row();
}

void write_version_1(const MshContent& content, Output& out) {
  out.text("$NOD\n");
  write_nodes_1_2(content, out);
  out.text(fmt::format("$ENDNOD\n$ELM\n{}\n", content.cells.size()));
  for (const auto& cell : content.cells) {
    out.text(fmt::format("{} {} {} 1 {} ", cell.tag, cell.type, cell.group, cell.corners.size()));
    write_corners_1_2(content, cell, out);
  }
  out.text("$ENDELM\n");
}

void write_version_2(const MshContent& content, const MshForm& form, Output& out) {
  out.text("$Nodes\n");
  write_nodes_1_2(content, out);
  out.end_section("EndNodes");
  out.text(fmt::format("$Elements\n{}\n", content.cells.size()));
  for (const auto& cell : content.cells) {
    if (form.binary) {  // a run of one element each
      for (std::int64_t value : {std::int64_t{cell.type}, std::int64_t{1}, std::int64_t{2}})
        out.integer(value);
      out.integer(static_cast<std::int64_t>(cell.tag));
    } else {
      out.text(fmt::format("{} {} 2 ", cell.tag, cell.type));
    }
    out.integer(cell.group);
    out.integer(1);
    write_corners_1_2(content, cell, out);
  }
  out.end_section("EndElements");
}

/// One entity for each (dimension, group), numbered in that order.
std::map<std::pair<int, std::int32_t>, std::int32_t> entities(const MshContent& content) {
  std::map<std::pair<int, std::int32_t>, std::int32_t> numbers;
  for (const auto& cell : content.cells) numbers[{dimension_of(cell.type), cell.group}] = 0;
  std::int32_t next = 10;
  for (auto& [key, number] : numbers) number = next++;
  return numbers;
}

void write_entities(const MshContent& content, Output& out) {
  const auto numbers = entities(content);
  out.text("$Entities\n");
  for (int dimension = 0; dimension < 4; ++dimension) {
    const auto of_dimension = [&](const auto& entity) { return entity.first.first == dimension; };
    out.size(
        static_cast<std::uint64_t>(std::count_if(numbers.begin(), numbers.end(), of_dimension)));
  }
  out.end_row();
  for (const auto& [key, number] : numbers) {
    out.integer(number);
    for (int i = 0; i < (key.first == 0 ? 3 : 6); ++i) out.real(0.5);
    out.size(key.second == 0 ? 0 : 1);
    if (key.second != 0) out.integer(key.second);
    if (key.first > 0) {
      out.size(2);
      out.integer(1);
      out.integer(-2);
    }
    out.end_row();
  }
  out.end_section("EndEntities");
}

void write_nodes_4(const MshContent& content, Output& out) {
  const std::size_t half = content.points.size() / 2;
  out.text("$Nodes\n");
  for (std::uint64_t value : {std::uint64_t{2}, std::uint64_t{content.points.size()},
                              std::uint64_t{1}, std::uint64_t{9}}) {
    out.size(value);
  }
  out.end_row();
  for (int block = 0; block < 2; ++block) {
    const std::size_t begin = block == 0 ? 0 : half;
    const std::size_t end = block == 0 ? half : content.points.size();
    for (std::int64_t value : {2, 10, block}) out.integer(value);  // the second is parametric
    out.size(end - begin);
    out.end_row();
    for (std::size_t i = begin; i < end; ++i) {
      out.size(content.point_tags[i]);
      out.end_row();
    }
    for (std::size_t i = begin; i < end; ++i) {
      for (double coordinate : content.points[i]) out.real(coordinate);
      for (int k = 0; k < 2 * block; ++k) out.real(0.25);
      out.end_row();
    }
  }
  out.end_section("EndNodes");
}

void write_elements_4(const MshContent& content, Output& out) {
  const auto numbers = entities(content);
  out.text("$Elements\n");
  for (std::uint64_t value :
       {content.cells.size(), content.cells.size(), std::size_t{1}, std::size_t{9}}) {
    out.size(value);
  }
  out.end_row();
  for (const auto& cell : content.cells) {  // a block of one element each
    const int dimension = dimension_of(cell.type);
    for (std::int64_t value : {dimension, numbers.at({dimension, cell.group}), cell.type})
      out.integer(value);
    out.size(1);
    out.end_row();
    out.size(cell.tag);
    for (std::uint32_t corner : cell.corners) out.size(content.point_tags[corner]);
    out.end_row();
  }
  out.end_section("EndElements");
}

void write_data(std::string_view section, const MshContent::Data& data, Output& out) {
  out.text(fmt::format("${}\n1\n\"{}\"\n1\n0.5\n3\n0\n{}\n{}\n", section, data.name,
                       data.components, data.tags.size()));
  for (std::size_t i = 0; i < data.tags.size(); ++i) {
    out.integer(static_cast<std::int64_t>(data.tags[i]));
    for (std::uint32_t k = 0; k < data.components; ++k)
      out.real(data.values[i * data.components + k]);
    out.end_row();
  }
  out.end_section(fmt::format("End{}", section));
}

}  // namespace

std::string write_msh(const MshContent& content, const MshForm& form) {
  Output out(form);
  const std::string_view version = form.version;
  if (version == "1") {
    write_version_1(content, out);
    return out.take();
  }
  write_head(content, form, out);
  if (version == "2.2") {
    write_version_2(content, form, out);
  } else {
    write_entities(content, out);
    write_nodes_4(content, out);
    write_elements_4(content, out);
  }
  for (const auto& data : content.node_data) write_data("NodeData", data, out);
  for (const auto& data : content.element_data) write_data("ElementData", data, out);
  return out.take();
}

}  // namespace gmsim::test
