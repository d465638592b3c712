// SPDX-License-Identifier: MIT
// Needs a Python with meshio in GMSIM_PYTHON; tests/support/with_python.sh finds one.
#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "scene/import_mesh.h"
#include "support/source_map.h"

using namespace gmsim;
using support::Diagnostics;

namespace {

/// A folder for one test, and in it the one for temporary files, so that only its own are counted.
class Folder {
 public:
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("gmsim-meshio $x; " + std::to_string(getpid()));

  Folder() {
    std::filesystem::create_directories(temporary_);
    if (const char* before = getenv("TMPDIR")) before_ = before;
    setenv("TMPDIR", temporary_.c_str(), 1);
  }
  ~Folder() {
    if (before_) setenv("TMPDIR", before_->c_str(), 1);
    else unsetenv("TMPDIR");
    std::filesystem::remove_all(path);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  /// Folders that conversions have left behind.
  [[nodiscard]] std::size_t temporary_folders() const {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(temporary_))
      if (entry.path().filename().string().starts_with("gmsim-")) ++count;
    return count;
  }

 private:
  std::filesystem::path temporary_ = path / "tmp";
  std::optional<std::string> before_;
};

struct Imported {
  std::optional<scene::ImportedMesh> mesh;
  std::string messages;
};

Imported import_text(const Folder& folder, const std::string& name, const std::string& text) {
  std::ofstream(folder.path / name, std::ios::binary) << text;
  Diagnostics diagnostics;
  Imported result;
  result.mesh = scene::import_mesh_with_data(folder.path / name, {}, diagnostics);
  std::ostringstream out;
  support::render(diagnostics, support::SourceMap{}, out);
  result.messages = out.str();
  return result;
}

}  // namespace

TEST_CASE("formats of other programs come through meshio") {
  const Folder folder;

  SUBCASE("VTK with data; the folder name would upset a shell") {
    const auto [mesh, messages] = import_text(
        folder, "tet.vtk",
        "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n"
        "0 0 0 1 0 0 0 1 0 0 0 0.1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n"
        "CELL_DATA 1\nSCALARS stiffness double 1\nLOOKUP_TABLE default\n2.5\n");
    CAPTURE(messages);
    REQUIRE(mesh);
    CHECK(mesh->mesh.kinds == std::vector{gmap::Mesh::CellKind::Tetrahedron});
    CHECK(mesh->mesh.points[3] == std::array{0.0, 0.0, 0.1});
    REQUIRE(mesh->cell_data.size() == 1);
    CHECK(mesh->cell_data[0].name == "stiffness");
    CHECK(mesh->cell_data[0].values == std::vector{2.5});
    CHECK(mesh->mesh.regions.empty());
  }
  SUBCASE("Medit references become regions") {
    const auto [mesh, messages] = import_text(folder, "two.mesh",
                                              "MeshVersionFormatted 2\nDimension 3\nVertices\n5\n0 "
                                              "0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n1 1 1 0\n"
                                              "Tetrahedra\n2\n1 2 3 4 7\n2 3 4 5 8\nEnd\n");
    CAPTURE(messages);
    REQUIRE(mesh);
    CHECK(mesh->mesh.regions == std::vector<std::int32_t>{7, 8});
  }
  SUBCASE("Abaqus element sets become named regions") {
    const auto [mesh, messages] = import_text(folder, "two.inp",
                                              "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 1, 1, "
                                              "0\n*ELEMENT, TYPE=CPS3\n1, 1, 2, 3\n2, 2, 4, 3\n"
                                              "*ELSET, ELSET=LEFT\n1\n");
    CAPTURE(messages);
    REQUIRE(mesh);
    REQUIRE(mesh->mesh.regions == std::vector<std::int32_t>{1, 0});
    CHECK(mesh->mesh.region_names[1] == "LEFT");
  }
  SUBCASE("polygons stay polygons") {
    const auto [mesh, messages] =
        import_text(folder, "mixed.ply",
                    "ply\nformat ascii 1.0\nelement vertex 6\nproperty double x\nproperty double "
                    "y\nproperty double z\n"
                    "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
                    "0 0 0\n1 0 0\n2 0.3 0\n1 1 0\n0 1 0\n0 2 0\n5 0 1 2 3 4\n3 4 3 5\n");
    CAPTURE(messages);
    REQUIRE(mesh);
    CHECK(mesh->mesh.cell_begin == std::vector<std::uint32_t>{0, 5, 8});
    CHECK(mesh->mesh.points[2] == std::array{2.0, 0.3, 0.0});
  }
  SUBCASE("what meshio cannot read is said in its words") {
    const auto [mesh, messages] = import_text(folder, "broken.vtk", "no mesh\n");
    CHECK_FALSE(mesh);
    CHECK(messages.find("meshio cannot convert this file [mesh-format]") != std::string::npos);
    CHECK(messages.find("it says: ") != std::string::npos);
  }
  SUBCASE("an unknown extension") {
    const auto [mesh, messages] = import_text(folder, "mesh.unknown", "no mesh\n");
    CHECK_FALSE(mesh);
    CHECK(messages.find("[mesh-format]") != std::string::npos);
  }
  CHECK(folder.temporary_folders() == 0);
}
