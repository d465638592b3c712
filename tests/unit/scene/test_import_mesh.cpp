// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "gmap/mesh.h"
#include "scene/import_mesh.h"
#include "scene/run_process.h"
#include "support/source_map.h"
#include "unit/scene/random_msh.h"

using namespace gmsim;
using scene::import_mesh;
using scene::MeshImportOptions;
using support::Diagnostics;

namespace {

/// A folder for the files of one test case.
struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("gmsim-import-" + std::to_string(getpid()));
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() { std::filesystem::remove_all(path); }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name, std::ios::binary) << text;
    return path / name;
  }
};

std::string rendered(const Diagnostics& diagnostics) {
  std::ostringstream out;
  support::render(diagnostics, support::SourceMap{}, out);
  return out.str();
}

constexpr const char* kMixed =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n2 4 \"skin\"\n3 4 \"core\"\n3 70000 "
    "\"far\"\n"
    "$EndPhysicalNames\n"
    "$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n9 5 5 5\n$EndNodes\n"
    "$Elements\n4\n1 15 2 0 1 1\n2 1 2 0 1 1 2\n3 2 2 4 1 1 2 3\n4 4 2 4 1 1 2 3 4\n$EndElements\n"
    "$ElementData\n1\n\"stiffness\"\n1\n0\n3\n0\n1\n1\n4 7.5\n$EndElementData\n"
    "$NodeData\n1\n\"half\"\n1\n0\n3\n0\n1\n2\n1 1\n2 2\n$EndNodeData\n";

}  // namespace

TEST_CASE("the highest dimension is kept unless another is asked for") {
  const Folder folder;
  const auto path = folder.write("mixed.msh", kMixed);
  Diagnostics diagnostics;
  const auto solid = scene::import_mesh_with_data(path, {}, diagnostics);
  REQUIRE(solid);
  CHECK(solid->mesh.dimension == 3);
  CHECK(solid->mesh.kinds == std::vector{gmap::Mesh::CellKind::Tetrahedron});
  CHECK(solid->mesh.cell_points == std::vector<std::uint32_t>{0, 1, 2, 3});
  CHECK(solid->mesh.points.size() == 5);
  CHECK(solid->mesh.regions == std::vector<std::int32_t>{4});
  REQUIRE(solid->mesh.region_names.size() == 5);
  CHECK(solid->mesh.region_names[4] == "core");
  REQUIRE(solid->cell_data.size() == 1);
  CHECK(solid->cell_data[0].values == std::vector{7.5});
  CHECK(solid->point_data.empty());
  CHECK_FALSE(diagnostics.has_errors());
  const std::string text = rendered(diagnostics);
  CHECK(text.find("1 segments, 1 triangles left out; the mesh is made of its 1 tetrahedra") !=
        std::string::npos);
  CHECK(text.find("data `half` is given for a part of the mesh only and is left out") !=
        std::string::npos);
  CHECK(text.find("group 70000 keeps its number only") != std::string::npos);

  Diagnostics of_surface;
  const auto surface = import_mesh(path, {.dimension = 2}, of_surface);
  REQUIRE(surface);
  CHECK(surface->cell_points == std::vector<std::uint32_t>{0, 1, 2});
  CHECK(surface->region_names[4] == "skin");
  const auto without = import_mesh(path, {.dimension = 2, .keep_regions = false}, of_surface);
  REQUIRE(without);
  CHECK(without->regions.empty());
}

TEST_CASE("what cannot be imported is said") {
  const Folder folder;
  const auto fails = [&](const std::filesystem::path& path, MeshImportOptions options = {}) {
    Diagnostics diagnostics;
    CHECK_FALSE(import_mesh(path, options, diagnostics));
    REQUIRE(diagnostics.error_count() == 1);
    const support::Diagnostic& error = diagnostics.all().front();
    std::string text = std::string(name_of(error.kind)) + ": " + error.message;
    for (const std::string& note : error.notes) text += "; " + note;
    return text + "; " + error.help;
  };
  CHECK(fails(folder.path / "none.msh").starts_with("file-error: "));
  CHECK(fails(folder.path / "none.msh").find("there is no such file") != std::string::npos);
  CHECK(fails(folder.path).find("this is a folder, not a mesh file") != std::string::npos);
  CHECK(fails(folder.write("bad.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\nx\n"))
            .find("bad.msh:5: `x` where the number of nodes is expected") != std::string::npos);
  const auto lines = folder.write("lines.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n");
  const std::string no_solid = fails(lines, {.dimension = 3});
  CHECK(no_solid.starts_with("mesh-topology: "));
  CHECK(no_solid.find("the mesh has no cells of dimension 3") != std::string::npos);
  CHECK(no_solid.find("it has 1 segments") != std::string::npos);
  CHECK(fails(folder.write("empty.obj", "")).find("the mesh has no cells") != std::string::npos);
  CHECK(fails(folder.write("run.vtkhdf", "x")).find("gmsim export") != std::string::npos);
  const std::string missing =
      fails(folder.write("some.ply", "ply\n"), {.python = "/nowhere/python"});
  CHECK(missing.find("meshio convert") != std::string::npos);
  CHECK(missing.starts_with("file-error: "));
}

TEST_CASE("the organ is clean") {
  Diagnostics diagnostics;
  const auto organ = import_mesh("tests/meshes/organ.msh", diagnostics);
  REQUIRE(organ);
  CHECK(diagnostics.all().empty());
  CHECK(organ->cell_count() == 607);
  CHECK(organ->points.size() == 210);
  CHECK(organ->region_names[1] == "organ");
  const gmap::MeshMap built = gmap::build_map(*organ);
  CHECK(built.problems.empty());
  CHECK(built.map.dart_count() == 24 * 607);
}

TEST_CASE("arguments of a process are not read by a shell") {
  const auto result = scene::run_process({"printf", "%s", "$(echo no); 'x' \"y\" *"});
  REQUIRE(result);
  CHECK(result->exit_code == 0);
  CHECK(result->output == "$(echo no); 'x' \"y\" *");
  CHECK_FALSE(scene::run_process({"/nowhere/program"}));
  CHECK(scene::run_process({"sh", "-c", "exit 3"})->exit_code == 3);
  CHECK(scene::run_process({"sh", "-c", "kill -9 $$"})->exit_code == 137);
  CHECK(scene::run_process({"sh", "-c", "head -c 1000000 /dev/zero"})->output.size() == 64 * 1024);
}
