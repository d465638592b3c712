// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>

#include "io/base64.h"
#include "io/obj_writer.h"
#include "io/usd_writer.h"
#include "io/vtu_writer.h"
#include "scene/import_mesh.h"

using namespace gmsim;
using io::MeshFrame;
using io::VtkCell;

namespace {

std::string base64(std::string_view text) {
  std::string result;
  io::append_base64(std::as_bytes(std::span(text)), result);
  return result;
}

MeshFrame sheet() {
  MeshFrame frame;
  frame.points = {{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.3, 1e-17}, {0, 1, 0}, {-1, 0.5, 0}};
  frame.topology.add_cell(VtkCell::Polygon, std::vector<std::int32_t>{0, 1, 2, 3, 4});
  frame.topology.add_cell(VtkCell::Triangle, std::vector<std::int32_t>{2, 1, 0});
  return frame;
}

}  // namespace

TEST_CASE("base64: the test vectors of RFC 4648") {
  CHECK(base64("") == "");
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foo") == "Zm9v");
  CHECK(base64("foob") == "Zm9vYg==");
  CHECK(base64("fooba") == "Zm9vYmE=");
  CHECK(base64("foobar") == "Zm9vYmFy");
  CHECK(base64("\xff\xfe\xfd") == "//79");
}

TEST_CASE("a written .obj reads back bit by bit") {
  const MeshFrame frame = sheet();
  const auto path =
      std::filesystem::temp_directory_path() / ("gmsim-obj-" + std::to_string(getpid()) + ".obj");
  support::Diagnostics diagnostics;
  REQUIRE(io::write_obj(path, frame, diagnostics));
  const auto mesh = scene::import_mesh(path, diagnostics);
  std::filesystem::remove(path);
  REQUIRE(mesh);
  CHECK(mesh->points == frame.points);
  CHECK(mesh->cell_points == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 2, 1, 0});
}

TEST_CASE("a file that cannot be written is an error with its reason") {
  support::Diagnostics diagnostics;
  CHECK_FALSE(io::write_vtu("/nowhere/x.vtu", sheet(), diagnostics));
  REQUIRE(diagnostics.error_count() == 1);
  CHECK(diagnostics.all()[0].kind == support::DiagnosticKind::FileError);
  CHECK(diagnostics.all()[0].message ==
        "/nowhere/x.vtu: the file cannot be written: No such file or directory");
}

TEST_CASE("names in a .vtu are escaped") {
  MeshFrame frame = sheet();
  frame.cell_data.push_back({"a<b & \"c\"", 1, io::NumberType::Int32, {1, 2}});
  CHECK(io::vtu_text(frame).find("Name=\"a&lt;b &amp; &quot;c&quot;\"") != std::string::npos);
}

TEST_CASE("a moving surface in .usda: faces only where they change, times in codes of 1/24 s") {
  MeshFrame frame;
  frame.points = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}};
  frame.topology.add_cell(VtkCell::Triangle, std::vector<std::int32_t>{0, 1, 2});
  frame.time = 2.0;
  io::UsdText text;
  text.add_frame(frame, true);
  frame.time = 2.5;
  frame.points[2][2] = 0.25;
  text.add_frame(frame, false);
  CHECK(text.finish() ==
        "#usda 1.0\n(\n    defaultPrim = \"body\"\n    metersPerUnit = 1\n    upAxis = \"Z\"\n"
        "    startTimeCode = 0\n    endTimeCode = 12\n    timeCodesPerSecond = 24\n)\n\n"
        "def Mesh \"body\"\n{\n    uniform token subdivisionScheme = \"none\"\n"
        "    point3f[] points.timeSamples = {\n"
        "            0: [(0, 0, 0), (1, 0, 0), (0.5, 1, 0)],\n"
        "            12: [(0, 0, 0), (1, 0, 0), (0.5, 1, 0.25)],\n    }\n"
        "    int[] faceVertexCounts.timeSamples = {\n            0: [3],\n    }\n"
        "    int[] faceVertexIndices.timeSamples = {\n            0: [0, 1, 2],\n    }\n}\n");
}
