// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include "io/html_view.h"
#include "io/sha256.h"
#include "io/view_frames.h"
#include "io/viewer/viewer.h"
#include "unit/io/synthetic_run.h"
#include "view/view_page.h"

using namespace gmsim;
using support::Diagnostics;
using test::SyntheticRun;
using test::ViewPage;

namespace {

struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("gmsim-view-" + std::to_string(getpid()));
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() { std::filesystem::remove_all(path); }
};

std::string message_of(const Diagnostics& diagnostics) {
  return diagnostics.all().empty() ? "" : diagnostics.all().front().message;
}

/// A run of so many frames, closed or left as a .part.
std::unique_ptr<io::TrajectoryReader> written(const SyntheticRun& run, std::int64_t frames,
                                              const std::filesystem::path& path, bool close) {
  Diagnostics diagnostics;
  const auto writer =
      io::TrajectoryWriter::create(path, run.description(), {.force = true}, diagnostics);
  REQUIRE(writer);
  for (std::int64_t i = 0; i < frames; ++i) REQUIRE(run.write(*writer, i, diagnostics));
  if (close) REQUIRE(writer->close("", diagnostics));
  auto reader = io::TrajectoryReader::open(close ? path : io::part_path(path), diagnostics);
  REQUIRE_MESSAGE(reader, message_of(diagnostics));
  return reader;
}

ViewPage page_of(const io::TrajectoryReader& reader, const io::HtmlViewOptions& options) {
  Diagnostics diagnostics;
  const auto view = io::html_view(reader, options, diagnostics);
  REQUIRE_MESSAGE(view, message_of(diagnostics));
  CHECK(diagnostics.all().empty());
  ViewPage page = test::read_page(view->text);
  CHECK(view->frames == std::ssize(page.frames));
  return page;
}

double length(const std::vector<double>& values, std::size_t components, std::size_t row) {
  double sum = 0;
  for (std::size_t i = 0; i < components; ++i)
    sum += values[row * components + i] * values[row * components + i];
  return components == 1 ? values[row] : std::sqrt(sum);
}

/// Half a step of so many between the ends, and what rounding of double and float adds.
double bound(double low, double high, double steps) {
  return (high - low) / steps * (0.5 + 1e-6) + 1e-9 * std::max(std::abs(low), std::abs(high));
}

void check_positions(const ViewPage& page, const ViewPage::Frame& shown,
                     const SyntheticRun::Frame& frame) {
  const ViewPage::Mesh& mesh = page.meshes[shown.mesh];
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      REQUIRE(std::abs(shown.positions[i][axis] - frame.points[mesh.points[i]][axis]) <=
              bound(page.low[axis], page.high[axis], 65534));
}

void check_values(const ViewPage& page, const ViewPage::Frame& shown,
                  const SyntheticRun::Frame& frame, const io::RunDescription& run) {
  const ViewPage::Mesh& mesh = page.meshes[shown.mesh];
  for (std::size_t i = 0; i < page.fields.size(); ++i) {
    const auto found = std::find_if(run.fields.begin(), run.fields.end(), [&](const auto& field) {
      return field.name == page.fields[i].name;
    });
    REQUIRE(found != run.fields.end());
    CAPTURE(found->name);
    CHECK(page.fields[i].unit == found->unit);
    CHECK(page.fields[i].expression == found->expression);
    const auto& values = frame.fields[static_cast<std::size_t>(found - run.fields.begin())];
    const auto& rows = page.fields[i].on == "point" ? mesh.points : mesh.cells;
    REQUIRE(shown.values[i].size() == rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
      REQUIRE(std::abs(shown.values[i][k] - length(values, found->components, rows[k])) <=
              bound(page.fields[i].low, page.fields[i].high, 254));
  }
}

/// Every triangle belongs to the cell it claims, polygons have all of theirs, and no point or cell
/// is kept for nothing.
void check_mesh(const ViewPage::Mesh& mesh, const io::MeshTopology& topology, std::size_t points) {
  CHECK(mesh.all_points == points);
  CHECK(mesh.all_cells == topology.cell_count());
  std::vector<std::size_t> triangles_of(topology.cell_count());
  std::set<std::uint32_t> used;
  for (std::size_t i = 0; i < mesh.triangle_cells.size(); ++i) {
    const std::uint32_t cell = mesh.cells.at(mesh.triangle_cells[i]);
    ++triangles_of.at(cell);
    const auto corners = topology.corners(cell);
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) {
      used.insert(mesh.triangles[k]);
      const auto point = static_cast<std::int32_t>(mesh.points.at(mesh.triangles[k]));
      CHECK(std::find(corners.begin(), corners.end(), point) != corners.end());
    }
  }
  for (std::size_t cell = 0; cell < triangles_of.size(); ++cell) {
    const io::VtkCell type = topology.types[cell];
    const bool polygon = type == io::VtkCell::Triangle || type == io::VtkCell::Quad ||
                         type == io::VtkCell::Polygon;
    if (polygon) CHECK(triangles_of[cell] == topology.corners(cell).size() - 2);
  }
  CHECK(used.size() == mesh.points.size());
}

void check_page(const SyntheticRun& run, const ViewPage& page) {
  for (const ViewPage::Frame& shown : page.frames) {
    CAPTURE(shown.number);
    const SyntheticRun::Frame frame = run.frame(shown.number);
    CHECK(shown.time == frame.time);
    CHECK(shown.step == frame.step);
    std::size_t tears = 0;
    for (std::int64_t i = 0; i <= shown.number; ++i) tears += run.frame(i).events.size();
    CHECK(shown.tears == tears);
    check_mesh(page.meshes[shown.mesh], frame.mesh, frame.points.size());
    check_positions(page, shown, frame);
    check_values(page, shown, frame, run.description());
  }
}

}  // namespace

TEST_CASE("pages hold every frame of runs whose mesh changes, as exactly as they promise") {
  const Folder folder;
  for (std::uint32_t seed = 1; seed <= 8; ++seed) {
    CAPTURE(seed);
    const SyntheticRun run(
        {.seed = seed, .dimension = seed % 2 == 0 ? 3 : 2, .polyhedra = seed % 4 == 0});
    const auto reader = written(run, 40, folder.path / "run.vtkhdf", true);
    const ViewPage page = page_of(*reader, {.title = "run"});
    CHECK(page.frames.size() == 40);
    CHECK(page.frames_in_file == 40);
    CHECK(page.complete);
    CHECK(page.meshes.size() == static_cast<std::size_t>(reader->summary().epochs));
    CHECK(page.fields.size() == 6);  // not those on frames and on corners
    check_page(run, page);
  }
}

TEST_CASE("pages of fewer frames, also of a run that goes on, hold the first and the last") {
  const Folder folder;
  const SyntheticRun run({.seed = 5});
  const auto reader = written(run, 40, folder.path / "run.vtkhdf", false);
  for (const std::int64_t frames : {2, 7, 39}) {
    const ViewPage page = page_of(*reader, {.frames = frames, .field = "mass"});
    CHECK_FALSE(page.complete);
    CHECK(page.field == "mass");
    REQUIRE(std::ssize(page.frames) == frames);
    CHECK(page.frames.front().number == 0);
    CHECK(page.frames.back().number == 39);
    check_page(run, page);
  }
  CHECK(page_of(*reader, {.frames = 1}).frames.front().number == 39);
}

TEST_CASE("frames are taken evenly") {
  for (std::int64_t count = 1; count <= 60; ++count) {
    for (std::int64_t limit = 2; limit <= 62; ++limit) {
      const auto frames = io::even_frames(count, limit);
      REQUIRE(std::ssize(frames) == std::min(count, limit));
      CHECK(frames.back() == count - 1);
      if (count > 1) CHECK(frames.front() == 0);
      for (std::size_t i = 1; i < frames.size(); ++i) {
        const double even =
            static_cast<double>(count - 1) / static_cast<double>(std::ssize(frames) - 1);
        CHECK(std::abs(static_cast<double>(frames[i] - frames[i - 1]) - even) < 1);
        CHECK(frames[i] > frames[i - 1]);
      }
    }
  }
}

TEST_CASE("the outline of a sheet comes first among its edges, lines and dots keep their cells") {
  io::MeshTopology topology;
  topology.add_cell(io::VtkCell::Vertex, std::array<std::int32_t, 1>{7});
  topology.add_cell(io::VtkCell::Quad, std::array<std::int32_t, 4>{0, 1, 4, 3});
  topology.add_cell(io::VtkCell::Line, std::array<std::int32_t, 2>{5, 6});
  topology.add_cell(io::VtkCell::Quad, std::array<std::int32_t, 4>{1, 2, 5, 4});
  const std::vector<std::array<double, 3>> points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0},
                                                     {1, 1, 0}, {2, 1, 0}, {3, 1, 0}, {9, 9, 0},
                                                     {8, 8, 8}};
  const io::ViewMesh mesh = io::view_mesh(topology, points);
  CHECK(mesh.points.size() == 8);  // nothing hangs on point 8
  CHECK(mesh.triangle_cells.size() == 4);
  REQUIRE(mesh.edges.size() == 14);
  REQUIRE(mesh.outline_edges == 6);
  const std::set<std::uint32_t> inner = {mesh.points[mesh.edges[12]], mesh.points[mesh.edges[13]]};
  CHECK(inner == std::set<std::uint32_t>{1, 4});
  REQUIRE(mesh.line_cells.size() == 1);
  CHECK(mesh.cells[mesh.line_cells[0]] == 2);
  CHECK(mesh.points[mesh.lines[1]] == 6);
  REQUIRE(mesh.dot_cells.size() == 1);
  CHECK(mesh.cells[mesh.dot_cells[0]] == 0);
}

TEST_CASE("a solid shows only the faces that one cell has") {
  io::MeshTopology topology;  // two tetrahedra, one face in common
  topology.add_cell(io::VtkCell::Tetrahedron, std::array<std::int32_t, 4>{0, 1, 2, 3});
  topology.add_cell(io::VtkCell::Tetrahedron, std::array<std::int32_t, 4>{1, 0, 2, 4});
  std::vector<std::array<double, 3>> points = {
      {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  CHECK(io::view_mesh(topology, points).triangle_cells.size() == 6);
  CHECK(io::view_mesh(topology, points).outline_edges == 0);
  points.insert(points.end(), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});  // torn apart
  topology.connectivity = {0, 1, 2, 3, 6, 5, 7, 4};
  CHECK(io::view_mesh(topology, points).triangle_cells.size() == 8);
}

TEST_CASE("what is not finite is told apart, counted and warned of") {
  const Folder folder;
  Diagnostics diagnostics;
  io::RunDescription run;
  run.fields = {{"heat", 1, io::FieldPlace::Point, io::NumberType::Float64, "", "<1,2>", "K"}};
  auto writer = io::TrajectoryWriter::create(folder.path / "run.vtkhdf", run, {}, diagnostics);
  REQUIRE(writer);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::array<double, 3>> points = {{0, 0, 0}, {4, kNan, 0}, {0, 2, 0}};
  const std::vector<double> heat = {1, 3, -std::numeric_limits<double>::infinity()};
  io::MeshTopology topology;
  topology.add_cell(io::VtkCell::Triangle, std::array<std::int32_t, 3>{0, 1, 2});
  const std::array<io::FrameField, 1> fields = {{{.values = std::span(heat)}}};
  REQUIRE(writer->write_frame({.points = points,
                               .topology = io::NewTopology{&topology, 6, {}},
                               .fields = fields,
                               .events = {}},
                              diagnostics));
  REQUIRE(writer->close("", diagnostics));
  const auto reader = io::TrajectoryReader::open(folder.path / "run.vtkhdf", diagnostics);
  REQUIRE(reader);
  const auto view = io::html_view(*reader, {}, diagnostics);
  REQUIRE(view);
  REQUIRE(diagnostics.all().size() == 1);
  CHECK(diagnostics.all()[0].severity == support::Severity::Warning);
  CHECK(diagnostics.all()[0].message.starts_with("1 position is not finite"));
  const ViewPage page = test::read_page(view->text);
  const auto& mesh = page.meshes[0];
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK((page.frames[0].steps[i][1] == 65535) == (mesh.points[i] == 1));
    CHECK((page.frames[0].value_steps[0][i] == 255) == (mesh.points[i] == 2));
  }
  CHECK(page.high == std::array<double, 3>{4, 2, 0});
  CHECK(page.fields[0].high == 3);
}

TEST_CASE("titles and names cannot break out of the page") {
  const Folder folder;
  const auto reader = written(SyntheticRun({.seed = 3}), 3, folder.path / "run.vtkhdf", true);
  Diagnostics diagnostics;
  const std::string title = "a \"b\" \\ </script><b>";
  const auto view = io::html_view(*reader, {.title = title}, diagnostics);
  REQUIRE(view);
  CHECK(test::read_page(view->text).title == title);
  CHECK(view->text.find("</script><b>") == std::string::npos);
  CHECK(io::viewer_script().find("</script") == std::string_view::npos);
  CHECK(view->text.find("@TITLE@") == std::string::npos);
}

TEST_CASE("fields that cannot be shown are refused, with a guess") {
  const Folder folder;
  const auto reader = written(SyntheticRun({.seed = 3}), 3, folder.path / "run.vtkhdf", true);
  const auto refused = [&](const std::string& field) {
    Diagnostics diagnostics;
    CHECK_FALSE(io::html_view(*reader, {.field = field}, diagnostics));
    REQUIRE(diagnostics.all().size() == 1);
    return diagnostics.all()[0];
  };
  CHECK(refused("velocty").message == "the file has no field `velocty`");
  CHECK(refused("velocty").help == "did you mean `velocity`?");
  CHECK(refused("xyz").help ==
        "there are `dart`, `mass`, `velocity`, `counter`, `material`, `stress`");
  CHECK(refused("kinetic_energy").message.find("neither on points nor on cells") !=
        std::string::npos);
}

TEST_CASE("a run that has written no frame yet has no page") {
  const Folder folder;
  Diagnostics diagnostics;
  const auto writer = io::TrajectoryWriter::create(
      folder.path / "run.vtkhdf", SyntheticRun({.seed = 3}).description(), {}, diagnostics);
  REQUIRE(writer);
  const auto reader =
      io::TrajectoryReader::open(folder.path / "run.vtkhdf.part", diagnostics);
  if (reader) {
    CHECK_FALSE(io::html_view(*reader, {}, diagnostics));
  }
  REQUIRE(diagnostics.has_errors());
  CHECK(message_of(diagnostics).find("no frame") != std::string::npos);
}

TEST_CASE("the bundled viewer was made from the sources beside it") {
  const std::filesystem::path folder = GMSIM_SOURCE_DIR "/interpreter/io/viewer";
  std::string first, second;
  std::istringstream bundle{std::string(io::viewer_script().substr(0, 1000))};
  std::getline(bundle, first);
  std::getline(bundle, second);
  std::istringstream names(first);
  std::string word, sources;
  names >> word >> word >> word;  // /* made from
  while (names >> word) {
    std::ifstream file(folder / word, std::ios::binary);
    REQUIRE_MESSAGE(file, word);
    sources += std::string(std::istreambuf_iterator<char>(file), {});
  }
  CHECK_MESSAGE(second == "   sha256 " + io::sha256(sources),
                "run `npm ci && npm run build` in interpreter/io/viewer");
}
