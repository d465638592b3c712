// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <random>

#include "scene/file_mesh.h"

using namespace gmsim;
using scene::CellKind;
using scene::FileMesh;

namespace {

std::string failure(std::string_view bytes) {
  try {
    const auto mesh = scene::read_obj(bytes);
    return "";
  } catch (const scene::MeshFileError& error) {
    return fmt::format("{}: {}", error.line.value(), error.message);
  }
}

}  // namespace

TEST_CASE("polygons of every arity keep their corners, and coordinates every bit") {
  std::mt19937 random(3);
  std::uniform_real_distribution<> real(-1, 1);
  std::string text = "# comment\nmtllib none.mtl\n";
  std::vector<std::array<double, 3>> points;
  for (int i = 0; i < 400; ++i) {
    points.push_back({real(random), real(random) * 1e-9, real(random) * 1e9});
    text += fmt::format("v {} {} {}\n", points.back()[0], points.back()[1], points.back()[2]);
  }
  std::vector<std::vector<std::uint32_t>> faces;
  for (std::uint32_t arity : {3u, 4u, 5u, 7u, 300u}) {
    faces.emplace_back();
    text += "f";
    for (std::uint32_t k = 0; k < arity; ++k) {
      faces.back().push_back((k * 7 + arity) % 400);
      const auto number = static_cast<int>(faces.back().back());
      text += k % 2 == 0 ? fmt::format(" {}", number + 1) : fmt::format(" {}//3", number - 400);
    }
    text += "\n";
  }
  const FileMesh mesh = scene::read_obj(text);
  CHECK(mesh.points == points);
  REQUIRE(mesh.cell_count() == faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    CHECK(std::vector<std::uint32_t>(
              mesh.corners.begin() + static_cast<std::ptrdiff_t>(mesh.begin[i]),
              mesh.corners.begin() + static_cast<std::ptrdiff_t>(mesh.begin[i + 1])) == faces[i]);
  }
}

TEST_CASE("groups, objects and lines") {
  const FileMesh mesh = scene::read_obj(
      "v 0 0 0\r\nv 1 0 0\nv 0 1 0\nv 1 1 0 1.0\n"
      "f 1 2 3\no sheet\nf 2 4 3\ng rim\nl 1 2 4\ng sheet\nf -1 -2 -3\n");
  CHECK(mesh.kinds == std::vector{CellKind::Polygon, CellKind::Polygon, CellKind::Segment,
                                  CellKind::Segment, CellKind::Polygon});
  CHECK(mesh.regions == std::vector<std::int32_t>{0, 1, 2, 2, 1});
  CHECK(mesh.region_names.at({2, 1}) == "sheet");
  CHECK(mesh.region_names.at({1, 2}) == "rim");
  CHECK(mesh.corners == std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2, 0, 1, 1, 3, 3, 2, 1});
}

TEST_CASE("errors name the line and the cause") {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  CHECK(failure("v 0 0\n") == "1: a vertex needs three coordinates");
  CHECK(failure("v 0 0 1e999\n") == "1: `1e999` is not a finite number");
  CHECK(failure("v 0 zero 0\n") == "1: `zero` is not a finite number");
  CHECK(failure(points + "f 1 2\n") == "4: a face with 2 corners");
  CHECK(failure(points + "f 1 2 4\n") ==
        "4: vertex 4 does not exist; there are 3 before this line");
  CHECK(failure(points + "f 1 2 -4\n") ==
        "4: vertex -4 does not exist; there are 3 before this line");
  CHECK(failure(points + "\nf 1 2 0\n") == "5: `0` is not a vertex number");
  CHECK(failure(points + "f 1 2 99999999999999999999\n") ==
        "4: `99999999999999999999` is not a vertex number");
  CHECK(failure(points + "f 1/1/1/2 2 3\n") == "4: `1/1/1/2` is not a vertex number");
  CHECK(failure(points + "f 1// 2/ 3//7\n") == "");
  CHECK(failure(points + "l 1\n") == "4: a line with 1 ends");
  CHECK(failure(points + std::string("f 1 2 3\n\0", 9)) ==
        "5: a null byte: this is not a text file");
}

TEST_CASE("every changed byte gives a mesh or an error") {
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\ng a b\nf 1/1/1 2//3 -1\nl 1 2\no x\nt tag 1/1/1 2 3 c\n";
  for (std::size_t at = 0; at < text.size(); ++at) {
    failure(std::string_view(text).substr(0, at));
    for (int value = 0; value < 256; ++value) {
      std::string changed = text;
      changed[at] = static_cast<char>(value);
      failure(changed);
    }
  }
}
