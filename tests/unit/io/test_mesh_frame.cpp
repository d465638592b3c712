// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "gmap/mesh.h"
#include "gmap/mesh_builders.h"
#include "io/mesh_frame_from_map.h"
#include "io/surface.h"
#include "unit/io/polyhedron_map.h"

using namespace gmsim;
using gmap::DartId;
using gmap::OrbitIndex;
using gmap::OrbitType;
using io::MapFrame;
using io::MeshTopology;
using io::PointNumbering;
using io::VtkCell;
using Point = std::array<double, 3>;

namespace {

MapFrame frame_of(const gmap::Mesh& mesh) {
  const gmap::MeshMap built = gmap::build_map(mesh);
  const OrbitIndex vertices(built.map, OrbitType::cell(0, mesh.dimension));
  return io::mesh_frame_from_map(
      built.map, vertices, PointNumbering(vertices, built.point_dart),
      [&](DartId d) { return mesh.points[built.dart_point[gmap::index(d)]]; });
}

MapFrame frame_of(const test::SolidMap& solid, const std::vector<Point>& points,
                  io::PolyhedronStyle style = io::PolyhedronStyle::Polyhedra) {
  const OrbitIndex vertices(solid.map, OrbitType::cell(0, 3));
  return io::mesh_frame_from_map(
      solid.map, vertices, PointNumbering(vertices),
      [&](DartId d) { return solid.position(points, d); }, style);
}

VtkCell type_of(const gmap::Mesh& mesh, std::size_t cell) {
  switch (mesh.kinds[cell]) {
    case gmap::Mesh::CellKind::Segment:
      return VtkCell::Line;
    case gmap::Mesh::CellKind::Polygon:
      return io::polygon_type(mesh.cell_begin[cell + 1] - mesh.cell_begin[cell]);
    case gmap::Mesh::CellKind::Tetrahedron:
      return VtkCell::Tetrahedron;
    case gmap::Mesh::CellKind::Hexahedron:
      return VtkCell::Hexahedron;
    case gmap::Mesh::CellKind::Prism:
      return VtkCell::Wedge;
    case gmap::Mesh::CellKind::Pyramid:
      return VtkCell::Pyramid;
  }
  return VtkCell::Vertex;
}

void check_same(const MapFrame& frame, const gmap::Mesh& mesh) {
  CHECK(frame.mesh.points == mesh.points);
  REQUIRE(frame.mesh.topology.cell_count() == mesh.cell_count());
  CHECK(std::ranges::equal(frame.mesh.topology.connectivity, mesh.cell_points));
  CHECK(std::ranges::equal(frame.mesh.topology.offsets, mesh.cell_begin));
  for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
    CHECK(frame.mesh.topology.types[cell] == type_of(mesh, cell));
  }
}

/// Of the body inside a surface seen from outside (divergence theorem).
double enclosed_volume(const io::Surface& surface, const std::vector<Point>& points) {
  double volume = 0;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const auto polygon = surface.polygon(i);
    const auto at = [&](std::size_t k) { return points[static_cast<std::size_t>(polygon[k])]; };
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
      const Point a = at(0), b = at(k), c = at(k + 1);
      volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                 a[2] * (b[0] * c[1] - b[1] * c[0])) /
                6;
    }
  }
  return volume;
}

/// The unit prism over a regular polygon.
std::pair<std::vector<Point>, std::vector<std::vector<std::uint32_t>>> prism(std::uint32_t sides) {
  std::vector<Point> points;
  std::vector<std::vector<std::uint32_t>> faces(2);
  for (double z : {0.0, 1.0}) {
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle = 2 * M_PI * i / sides;
      points.push_back({std::cos(angle), std::sin(angle), z});
    }
  }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t next = (i + 1) % sides;
    faces[0].insert(faces[0].begin(), i);
    faces[1].push_back(sides + i);
    faces.push_back({i, next, sides + next, sides + i});
  }
  return {points, faces};
}

double prism_volume(std::uint32_t sides) {
  return 0.5 * sides * std::sin(2 * M_PI / sides);
}

std::vector<std::vector<std::uint32_t>> facets_of(VtkCell type) {
  switch (type) {
    case VtkCell::Tetrahedron:
      return {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    case VtkCell::Pyramid:
      return {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    default:
      return {};
  }
}

}  // namespace

TEST_CASE("grids, boxes and chains come back as they were built") {
  using gmap::BoxElements;
  using gmap::GridCells;
  for (GridCells cells : {GridCells::Quads, GridCells::Triangles, GridCells::Tri4, GridCells::Mix2,
                          GridCells::Mix4}) {
    const gmap::Mesh mesh = gmap::grid(4, 3, 2.0, 1.0, cells);
    check_same(frame_of(mesh), mesh);
  }
  for (BoxElements elements : {BoxElements::Hexes, BoxElements::Tets6, BoxElements::Tets5}) {
    const gmap::Mesh mesh = gmap::box({2, 3, 2}, {1, 2, 3}, elements);
    check_same(frame_of(mesh), mesh);
  }
  const gmap::Mesh chain = gmap::chain(5, 1.0);
  check_same(frame_of(chain), chain);
}

TEST_CASE("the surface of a box is closed, turned outwards, and has the faces of one cell only") {
  using gmap::BoxElements;
  for (BoxElements elements : {BoxElements::Hexes, BoxElements::Tets6, BoxElements::Tets5}) {
    const gmap::Mesh mesh = gmap::box({3, 2, 4}, {1, 2, 3}, elements);
    const MapFrame frame = frame_of(mesh);
    const io::Surface surface = io::visible_surface(frame.mesh.topology);
    const std::size_t patches = 2 * (3 * 2 + 2 * 4 + 4 * 3);
    CHECK(surface.size() == (elements == BoxElements::Hexes ? patches : 2 * patches));
    CHECK(enclosed_volume(surface, frame.mesh.points) == doctest::Approx(6));
  }
}

TEST_CASE("solids are recognised under any dart ids, and turned to positive volume") {
  std::mt19937 random(5);
  for (int trial = 0; trial < 200; ++trial) {
    CAPTURE(trial);
    for (VtkCell type :
         {VtkCell::Tetrahedron, VtkCell::Pyramid, VtkCell::Wedge, VtkCell::Hexahedron}) {
      std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
      auto faces = facets_of(type);
      if (type == VtkCell::Pyramid)
        points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}};
      if (faces.empty()) std::tie(points, faces) = prism(type == VtkCell::Wedge ? 3 : 4);
      const double expected = type == VtkCell::Tetrahedron ? 1 / 6.0
                              : type == VtkCell::Pyramid   ? 1 / 3.0
                              : type == VtkCell::Wedge     ? prism_volume(3)
                                                           : prism_volume(4);
      if (trial % 2 == 1) {
        for (Point& point : points) point[0] = -point[0];
      }
      test::SolidMap solid;
      test::add_polyhedron(solid, faces);
      const MapFrame frame = frame_of(test::renumbered(solid, random), points);
      REQUIRE(frame.mesh.topology.types == std::vector{type});
      const io::Surface surface = io::visible_surface(frame.mesh.topology);
      CHECK(surface.size() == faces.size());
      CHECK(enclosed_volume(surface, frame.mesh.points) == doctest::Approx(expected));
    }
  }
}

TEST_CASE("other volumes are polyhedra whose faces are seen from outside") {
  std::mt19937 random(6);
  for (std::uint32_t sides : {5u, 6u, 9u}) {
    for (int trial = 0; trial < 20; ++trial) {
      auto [points, faces] = prism(sides);
      if (trial % 2 == 1) {
        for (Point& point : points) point[2] = -point[2];
      }
      test::SolidMap solid;
      test::add_polyhedron(solid, faces);
      const test::SolidMap other = test::renumbered(solid, random);
      const MapFrame frame = frame_of(other, points);
      REQUIRE(frame.mesh.topology.types == std::vector{VtkCell::Polyhedron});
      CHECK(frame.mesh.topology.faces(0).size() == sides + 2);
      CHECK(frame.mesh.topology.corners(0).size() == 2 * sides);
      CHECK(enclosed_volume(io::visible_surface(frame.mesh.topology), frame.mesh.points) ==
            doctest::Approx(prism_volume(sides)));

      const MapFrame as_faces = frame_of(other, points, io::PolyhedronStyle::Faces);
      CHECK_FALSE(as_faces.mesh.topology.has_polyhedra());
      CHECK(as_faces.mesh.topology.cell_count() == sides + 2);
      CHECK(as_faces.cell_darts.size() == sides + 2);
      std::set<DartId> of_volume(as_faces.cell_darts.begin(), as_faces.cell_darts.end());
      CHECK(of_volume.size() == sides + 2);
    }
  }
}

TEST_CASE("a hexahedron that is none: the same counts, other links") {
  test::SolidMap solid;
  auto [points, faces] = prism(4);
  test::add_polyhedron(solid, faces);
  solid.map.unlink(2, DartId{0});  // one link less: no hexahedron
  CHECK(frame_of(solid, points).mesh.topology.types == std::vector{VtkCell::Polyhedron});
}

TEST_CASE("open faces are written through their corners") {
  gmap::GMap map(2);
  map.add_darts(6);
  for (std::uint32_t i : {0u, 2u, 4u}) map.link(0, DartId{i}, DartId{i + 1});
  map.link(1, DartId{1}, DartId{2});
  map.link(1, DartId{3}, DartId{4});
  const OrbitIndex vertices(map, OrbitType::cell(0, 2));
  const MapFrame frame =
      io::mesh_frame_from_map(map, vertices, PointNumbering(vertices), [](DartId d) {
        return Point{static_cast<double>(gmap::index(d)), 0, 0};
      });
  CHECK(frame.mesh.topology.types == std::vector{VtkCell::Quad});
  REQUIRE(frame.mesh.points.size() == 4);
  std::vector<double> along;
  for (std::int32_t corner : frame.mesh.topology.corners(0)) {
    along.push_back(frame.mesh.points[static_cast<std::size_t>(corner)][0]);
  }
  if (along.front() > along.back()) std::reverse(along.begin(), along.end());
  CHECK(along == std::vector<double>{0, 1, 3, 5});
}

TEST_CASE("vertices keep their numbers; new ones follow; those behind the dead move up") {
  const gmap::Mesh mesh = gmap::grid(2, 2, 1, 1, gmap::GridCells::Quads);
  gmap::MeshMap built = gmap::build_map(mesh);
  OrbitIndex vertices(built.map, OrbitType::cell(0, 2));
  PointNumbering numbering(vertices, built.point_dart);
  REQUIRE(numbering.size() == 9);
  for (std::uint32_t point = 0; point < 9; ++point) {
    CHECK(numbering.number(vertices.row(built.point_dart[point])) ==
          static_cast<std::int32_t>(point));
  }
  const auto rewrite = [&](auto&& change) {
    std::vector<DartId> touched;
    change(touched);
    gmap::OrbitRepair repair;
    vertices.repair(built.map, touched, repair);
    numbering.update(vertices);
  };
  // Cut every link around the first quad: its corners become vertices of their own.
  rewrite([&](std::vector<DartId>& touched) {
    for (std::uint32_t i = 0; i < 8; ++i) {
      if (!built.map.is_free(2, DartId{i})) built.map.unsew(2, DartId{i}, &touched);
    }
  });
  CHECK(numbering.size() == 12);
  for (std::uint32_t point = 0; point < 9; ++point) {
    CHECK(vertices.alive(numbering.rows()[point]));
    CHECK(built.dart_point[gmap::index(vertices.smallest(numbering.rows()[point]))] == point);
  }
  // Remove it: its corners go, the old numbers they kept as well as the new ones.
  std::vector<gmap::Row> before(numbering.rows().begin(), numbering.rows().end());
  rewrite([&](std::vector<DartId>& touched) {
    for (std::uint32_t i = 0; i < 8; ++i) {
      for (int link : {0, 1}) {
        if (!built.map.is_free(link, DartId{i})) built.map.unlink(link, DartId{i});
      }
    }
    for (std::uint32_t i = 0; i < 8; ++i) {
      built.map.remove_dart(DartId{i});
      touched.push_back(DartId{i});
    }
  });
  CHECK(numbering.size() == 8);
  std::erase_if(before, [&](gmap::Row row) { return !vertices.alive(row); });
  CHECK(std::ranges::equal(numbering.rows(), before));
  for (std::size_t i = 0; i < numbering.size(); ++i) {
    CHECK(numbering.number(numbering.rows()[i]) == static_cast<std::int32_t>(i));
  }
}
