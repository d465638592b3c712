// SPDX-License-Identifier: MIT
// write_vtu_samples FOLDER: .vtu files of every kind of cell and number, and beside each what it
// must read as, in JSON. check_vtu.py compares them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "io/text_file.h"
#include "io/vtu_writer.h"

using namespace gmsim;
using io::MeshFrame;
using io::NumberType;
using io::VtkCell;
using Corners = std::vector<std::int32_t>;

namespace {

std::mt19937 random_bits(17);

std::string json(const MeshFrame& frame) {
  std::vector<int> types;
  std::vector<Corners> cells;
  std::vector<std::vector<Corners>> faces;
  for (std::size_t cell = 0; cell < frame.topology.cell_count(); ++cell) {
    types.push_back(static_cast<int>(frame.topology.types[cell]));
    const auto corners = frame.topology.corners(cell);
    cells.emplace_back(corners.begin(), corners.end());
    faces.emplace_back();
    for (std::int32_t number : frame.topology.faces(cell)) {
      const auto face = frame.topology.face(static_cast<std::size_t>(number));
      faces.back().emplace_back(face.begin(), face.end());
    }
  }
  const auto arrays = [](const std::vector<io::DataArray>& data) {
    std::vector<std::string> rows;
    for (const auto& array : data) {
      rows.push_back(fmt::format("\"{}\": [{}, {}]", array.name, array.components, array.values));
    }
    return fmt::format("{{{}}}", fmt::join(rows, ", "));
  };
  return fmt::format(
      "{{\"points\": {}, \"types\": {}, \"cells\": {}, \"faces\": {}, \"point_data\": {}, "
      "\"cell_data\": {}, \"time\": {}}}\n",
      frame.points, types, cells, faces, arrays(frame.point_data), arrays(frame.cell_data),
      *frame.time);
}

void add_data(MeshFrame& frame) {
  const auto fill = [](const std::string& name, std::uint32_t components, NumberType type,
                       std::size_t rows) {
    io::DataArray array{name, components, type, {}};
    std::uniform_real_distribution<> real(-1e6, 1e6);
    for (std::size_t i = 0; i < rows * components; ++i) {
      const double value = real(random_bits);
      const bool whole = type == NumberType::Int32 || type == NumberType::Int64;
      array.values.push_back(whole ? std::round(value)
                             : type == NumberType::Float32
                                 ? static_cast<double>(static_cast<float>(value))
                                 : value);
    }
    return array;
  };
  const std::size_t points = frame.points.size(), cells = frame.topology.cell_count();
  frame.point_data = {fill("velocity", 3, NumberType::Float64, points),
                      fill("mass", 1, NumberType::Float32, points),
                      fill("dart", 1, NumberType::Int32, points)};
  frame.cell_data = {fill("stress", 6, NumberType::Float32, cells),
                     fill("step", 1, NumberType::Int64, cells)};
}

MeshFrame frame_with(std::size_t points) {
  MeshFrame frame;
  std::uniform_real_distribution<> real(-1, 1);
  for (std::size_t i = 0; i < points; ++i) {
    frame.points.push_back({real(random_bits), real(random_bits), real(random_bits)});
  }
  frame.time = real(random_bits);
  return frame;
}

void add_pentagonal_prism(MeshFrame& frame) {
  frame.topology.add_polyhedron({{4, 3, 2, 1, 0},
                                 {5, 6, 7, 8, 9},
                                 {0, 1, 6, 5},
                                 {1, 2, 7, 6},
                                 {2, 3, 8, 7},
                                 {3, 4, 9, 8},
                                 {4, 0, 5, 9}});
}

bool save(const std::filesystem::path& folder, const std::string& name, MeshFrame frame) {
  add_data(frame);
  support::Diagnostics diagnostics;
  return io::write_vtu(folder / (name + ".vtu"), frame, diagnostics) &&
         io::write_file(folder / (name + ".json"), json(frame), diagnostics);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const std::filesystem::path folder = arguments[1];
  std::filesystem::create_directories(folder);
  MeshFrame sheet = frame_with(9);
  for (const Corners& corners :
       {Corners{0, 1, 2}, {2, 3, 4, 5}, {4, 5, 6, 7, 8}, {0, 1, 2, 3, 4, 5, 6}}) {
    sheet.topology.add_cell(io::polygon_type(corners.size()), corners);
  }
  MeshFrame solids = frame_with(12);
  solids.topology.add_cell(VtkCell::Tetrahedron, Corners{0, 1, 2, 3});
  solids.topology.add_cell(VtkCell::Hexahedron, Corners{0, 1, 2, 3, 4, 5, 6, 7});
  solids.topology.add_cell(VtkCell::Wedge, Corners{1, 2, 3, 4, 5, 6});
  solids.topology.add_cell(VtkCell::Pyramid, Corners{8, 9, 10, 11, 0});
  MeshFrame polyhedra = frame_with(10);
  add_pentagonal_prism(polyhedra);
  add_pentagonal_prism(polyhedra);
  MeshFrame mixed = frame_with(10);
  mixed.topology.add_cell(VtkCell::Tetrahedron, Corners{0, 1, 2, 9});
  add_pentagonal_prism(mixed);
  mixed.topology.add_cell(VtkCell::Tetrahedron, Corners{3, 1, 2, 9});
  MeshFrame chain = frame_with(3);
  chain.topology.add_cell(VtkCell::Line, Corners{0, 2});
  chain.topology.add_cell(VtkCell::Vertex, Corners{1});
  const bool ok = save(folder, "sheet", sheet) && save(folder, "solids", solids) &&
                  save(folder, "polyhedra", polyhedra) && save(folder, "mixed", mixed) &&
                  save(folder, "chain", chain) && save(folder, "no_cells", frame_with(4));
  return ok ? 0 : 1;
}
