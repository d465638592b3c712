// SPDX-License-Identifier: MIT
#include "io/vtu_writer.h"

#include <fmt/format.h>

#include <bit>

#include "io/base64.h"
#include "io/text_file.h"
#include "support/check.h"

namespace gmsim::io {

static_assert(std::endian::native == std::endian::little, "the header says LittleEndian");

namespace {

class VtuText {
 public:
  explicit VtuText(const MeshFrame& frame) : frame_(frame) {}

  std::string write() {
    out_ =
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n<UnstructuredGrid>\n";
    write_time();
    out_ += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
                        frame_.points.size(), frame_.topology.cell_count());
    out_ += "<Points>\n";
    array<double>("Float64", "Points", 3, flat_points());
    out_ += "</Points>\n<Cells>\n";
    write_cells();
    out_ += "</Cells>\n";
    write_data("PointData", frame_.point_data, frame_.points.size());
    write_data("CellData", frame_.cell_data, frame_.topology.cell_count());
    out_ += "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    return std::move(out_);
  }

 private:
  template <class Number>
  void array(std::string_view type, std::string_view name, std::uint32_t components,
             std::span<const Number> values, std::string_view more = {}) {
    out_ += fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"{} format=\"binary\">\n", type,
        xml_escaped(name), components, more);
    // Length and values are one run of base64.
    const auto bytes = std::as_bytes(values);
    const std::uint64_t length = bytes.size();
    std::vector<std::byte> block(sizeof length + bytes.size());
    std::copy_n(reinterpret_cast<const std::byte*>(&length), sizeof length, block.begin());
    std::copy(bytes.begin(), bytes.end(), block.begin() + sizeof length);
    append_base64(block, out_);
    out_ += "\n</DataArray>\n";
  }

  template <class Number>
  void converted(std::string_view type, const DataArray& data) {
    std::vector<Number> values;
    values.reserve(data.values.size());
    for (double value : data.values) values.push_back(static_cast<Number>(value));
    array<Number>(type, data.name, data.components, values);
  }

  [[nodiscard]] std::span<const double> flat_points() const {
    static_assert(sizeof(frame_.points[0]) == 3 * sizeof(double));
    if (frame_.points.empty()) return {};
    return {frame_.points.front().data(), 3 * frame_.points.size()};
  }

  void write_time() {
    if (!frame_.time) return;
    out_ += "<FieldData>\n";
    array<double>("Float64", "TimeValue", 1, std::span(&*frame_.time, 1), " NumberOfTuples=\"1\"");
    out_ += "</FieldData>\n";
  }

  void write_cells() {
    const MeshTopology& topology = frame_.topology;
    array<std::int32_t>("Int32", "connectivity", 1, topology.connectivity);
    array<std::int32_t>("Int32", "offsets", 1, std::span(topology.offsets).subspan(1));
    std::vector<std::uint8_t> types;
    for (VtkCell type : topology.types) types.push_back(static_cast<std::uint8_t>(type));
    array<std::uint8_t>("UInt8", "types", 1, types);
    if (topology.has_polyhedra()) write_faces();
  }

  /// For each polyhedron: number of faces, then for each face its size and corners; and for each
  /// cell where its list ends, -1 for cells of other types.
  void write_faces() {
    const MeshTopology& topology = frame_.topology;
    std::vector<std::int32_t> faces, ends;
    for (std::size_t cell = 0; cell < topology.cell_count(); ++cell) {
      if (topology.types[cell] != VtkCell::Polyhedron) {
        ends.push_back(-1);
        continue;
      }
      faces.push_back(static_cast<std::int32_t>(topology.faces(cell).size()));
      for (std::int32_t number : topology.faces(cell)) {
        const auto face = topology.face(static_cast<std::size_t>(number));
        faces.push_back(static_cast<std::int32_t>(face.size()));
        faces.insert(faces.end(), face.begin(), face.end());
      }
      ends.push_back(static_cast<std::int32_t>(faces.size()));
    }
    array<std::int32_t>("Int32", "faces", 1, faces);
    array<std::int32_t>("Int32", "faceoffsets", 1, ends);
  }

  void write_data(std::string_view section, const std::vector<DataArray>& arrays,
                  std::size_t rows) {
    out_ += fmt::format("<{}>\n", section);
    for (const DataArray& data : arrays) {
      GMSIM_CHECK(data.values.size() == rows * data.components, "an array does not fit its mesh");
      switch (data.type) {
        case NumberType::Float64:
          array<double>("Float64", data.name, data.components, data.values);
          break;
        case NumberType::Float32:
          converted<float>("Float32", data);
          break;
        case NumberType::Int64:
          converted<std::int64_t>("Int64", data);
          break;
        case NumberType::Int32:
          converted<std::int32_t>("Int32", data);
          break;
      }
    }
    out_ += fmt::format("</{}>\n", section);
  }

  const MeshFrame& frame_;
  std::string out_;
};

}  // namespace

std::string vtu_text(const MeshFrame& frame) {
  return VtuText(frame).write();
}

bool write_vtu(const std::filesystem::path& path, const MeshFrame& frame,
               support::Diagnostics& diagnostics) {
  return write_file(path, vtu_text(frame), diagnostics);
}

}  // namespace gmsim::io
