// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>

#include "scene/file_mesh.h"
#include "unit/scene/random_msh.h"

using namespace gmsim;
using gmsim::test::kMshForms;
using gmsim::test::MshContent;
using gmsim::test::MshForm;
using scene::CellKind;
using scene::FileMesh;

namespace {

CellKind kind_of(std::int32_t type) {
  switch (type) {
    case 1:
      return CellKind::Segment;
    case 2:
    case 3:
      return CellKind::Polygon;
    case 4:
      return CellKind::Tetrahedron;
    case 5:
      return CellKind::Hexahedron;
    case 6:
      return CellKind::Prism;
    default:
      return CellKind::Pyramid;
  }
}

void compare(const FileMesh& mesh, const MshContent& content, bool has_data) {
  REQUIRE(mesh.points == content.points);
  std::size_t cell = 0, points = 0;
  for (const auto& expected : content.cells) {
    if (expected.type == 15) {
      ++points;
      continue;
    }
    REQUIRE(cell < mesh.cell_count());
    CHECK(mesh.kinds[cell] == kind_of(expected.type));
    CHECK(mesh.regions[cell] == expected.group);
    const std::vector<std::uint32_t> corners(
        mesh.corners.begin() + static_cast<std::ptrdiff_t>(mesh.begin[cell]),
        mesh.corners.begin() + static_cast<std::ptrdiff_t>(mesh.begin[cell + 1]));
    CHECK(corners == expected.corners);
    ++cell;
  }
  CHECK(cell == mesh.cell_count());
  CHECK(points == mesh.point_cells);
  if (!has_data) return;
  CHECK(mesh.region_names.at({3, 2}) == "left lobe");
  REQUIRE(mesh.point_data.size() == 1);
  CHECK(mesh.point_data[0].values == content.node_data[0].values);
  REQUIRE(mesh.cell_data.size() == 1);
  CHECK(mesh.cell_data[0].components == 3);
  CHECK(mesh.cell_data[0].values == content.element_data[0].values);
}

std::string failure(std::string_view bytes) {
  try {
    const auto mesh = scene::read_msh(bytes);
    return "";
  } catch (const scene::MeshFileError& error) {
    return error.line ? fmt::format("{}: {}", *error.line, error.message)
                      : fmt::format("byte {}: {}", error.byte.value(), error.message);
  }
}

constexpr std::string_view kHead = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
constexpr std::string_view kNodes = "$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n";

}  // namespace

TEST_CASE("random meshes read back from every form of the format") {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    const MshContent content = test::random_msh(seed);
    for (const MshForm& form : kMshForms) {
      CAPTURE(seed);
      CAPTURE(form.name);
      FileMesh mesh;
      REQUIRE_NOTHROW(mesh = scene::read_msh(write_msh(content, form)));
      compare(mesh, content, std::string_view(form.version) != "1");
    }
  }
}

TEST_CASE("every truncation is an error, and ends") {
  const MshContent content = test::random_msh(7);
  for (const MshForm& form : kMshForms) {
    std::string bytes = write_msh(content, form);
    bytes.pop_back();  // the last line end may be missing
    CHECK(failure(bytes) == "");
    const std::size_t data = std::min(bytes.find("$NodeData"), bytes.size());
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      CAPTURE(form.name);
      CAPTURE(length);
      // Only between two sections can a shorter file be whole.
      const std::string text = failure(std::string_view(bytes).substr(0, length));
      if (text.empty()) CHECK(length >= data - 2);
    }
  }
}

TEST_CASE("every changed byte gives a mesh or an error") {
  const MshContent content = test::random_msh(11);
  for (const MshForm& form : kMshForms) {
    const std::string bytes = write_msh(content, form);
    for (std::size_t at = 0; at < bytes.size(); ++at) {
      for (int change : {0x01, 0x10, 0x80, 0xff}) {
        std::string changed = bytes;
        changed[at] = static_cast<char>(changed[at] ^ change);
        failure(changed);
      }
    }
  }
}

TEST_CASE("an element in several groups is one cell of the first group") {
  const std::string text = std::string(kHead) + std::string(kNodes) +
                           "$Elements\n4\n"
                           "1 2 2 7 1 1 2 3\n2 2 2 9 1 1 2 3\n3 2 2 5 1 1 2 3\n"
                           "4 2 2 7 2 1 2 3\n"
                           "$EndElements\n";
  const FileMesh mesh = scene::read_msh(text);
  CHECK(mesh.regions == std::vector<std::int32_t>{7, 7});
  CHECK(mesh.warnings ==
        std::vector<std::string>{"1 cells are in several physical groups; each keeps the first"});
}

TEST_CASE("errors name the line and the cause") {
  const std::string head(kHead), nodes(kNodes);
  CHECK(failure("") == "1: the file has no elements");
  CHECK(failure("solid\n") == "1: `solid` where a section such as $Nodes is expected");
  CHECK(failure("$Nodes\n") == "1: $Nodes before $MeshFormat");
  CHECK(failure("$MeshFormat\n4 0 8\n").find("2: version 4 of the format cannot be read") == 0);
  CHECK(failure("$MeshFormat\n2.2 2 8\n") == "2: the file type must be 0 (text) or 1 (binary)");
  CHECK(failure("$MeshFormat\n4.1 0 16\n") == "2: data size 16 cannot be read");
  CHECK(failure(head + "$Nodes\n3\n1 0 0 0\n2 1 0\n3 0 1 0\n$EndNodes\n") ==
        "9: `$EndNodes` where a coordinate, a finite number, is expected");
  CHECK(failure(head + "$Nodes\n1\n1 0 nan 0\n$EndNodes\n") ==
        "6: `nan` where a coordinate, a finite number, is expected");
  CHECK(failure(head + "$Nodes\n999999999\n1 0 0 0\n") ==
        "5: 999999999 nodes announced, but only 9 bytes are left in the file");
  CHECK(failure(head + "$Nodes\n2\n1 0 0 0\n1 1 0 0\n$EndNodes\n") ==
        "7: node 1 is given a second time");
  CHECK(failure(head + nodes + "$Elements\n1\n1 2 2 0 1 1 2 4\n$EndElements\n") ==
        "12: element 1 has node 4, which does not exist");
  CHECK(failure(head + nodes + "$Elements\n1\n1 77 2 0 1 1 2 3\n$EndElements\n") ==
        "12: element type 77 is unknown");
  CHECK(failure(head + nodes + "$Elements\n1\n1 9 2 0 1 1 2 3 1 2 3\n$EndElements\n")
            .find("12: a 6-node triangle of order 2 (element type 9) cannot be read") == 0);
  CHECK(failure(head + nodes + "$Elements\n1\n1 2 2 0 1 1 2 3\n$EndNodes\n") ==
        "13: `$EndNodes` where $EndElements is expected");
  CHECK(failure(head + nodes + nodes) == "10: a second section of nodes");
  CHECK(failure(head + "$Elements\n0\n") == "4: elements before the nodes they are made of");
  CHECK(failure(head + "$Comments\nhello\n") == "4: section $Comments never ends");
}

TEST_CASE("sections that shape no mesh are passed over") {
  const std::string text = std::string(kHead) + "$Comments\nwritten $by hand\n$EndComments\n" +
                           std::string(kNodes) +
                           "$Elements\n1\n1 2 0 1 2 3\n$EndElements\n$Periodic\n0\n$EndPeriodic";
  CHECK(scene::read_msh(text).cell_count() == 1);
}
