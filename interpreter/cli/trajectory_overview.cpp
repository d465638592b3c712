// SPDX-License-Identifier: MIT
#include "cli/trajectory_overview.h"

#include <algorithm>
#include <cmath>

namespace gmsim::cli {
namespace {

using support::Diagnostics;
using Range = TrajectoryOverview::Range;

void widen(std::optional<Range>& range, double value) {
  if (!range) range = Range{value, value};
  range->low = std::min(range->low, value);
  range->high = std::max(range->high, value);
}

void add_values(const io::DataArray& array, TrajectoryOverview::Field& field) {
  const std::size_t components = array.components;
  for (std::size_t row = 0; row + components <= array.values.size(); row += components) {
    const double* values = array.values.data() + row;
    if (!std::all_of(values, values + components, [](double x) { return std::isfinite(x); })) {
      ++field.not_finite;
    } else if (components == 3) {
      widen(field.range, std::hypot(values[0], values[1], values[2]));
    } else {
      for (std::size_t k = 0; k < components; ++k) widen(field.range, values[k]);
    }
  }
}

std::optional<io::DataArray> read_values(const io::TrajectoryReader& reader, std::size_t field,
                                         std::int64_t frame, Diagnostics& diagnostics) {
  if (reader.run().fields[field].place != io::FieldPlace::Orbit)
    return reader.read_field(field, frame, diagnostics);
  auto values = reader.read_orbit_field(field, frame, diagnostics);
  if (!values) return std::nullopt;
  return std::move(values->array);
}

bool read_fields(const io::TrajectoryReader& reader, TrajectoryOverview& overview,
                 Diagnostics& diagnostics) {
  const auto& fields = reader.run().fields;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    TrajectoryOverview::Field field{fields[i], std::nullopt, 0};
    for (std::int64_t frame = 0; frame < reader.summary().frames; ++frame) {
      const auto values = read_values(reader, i, frame, diagnostics);
      if (!values) return false;
      add_values(*values, field);
    }
    overview.fields.push_back(std::move(field));
  }
  return true;
}

TrajectoryOverview::Counts count(const io::MeshFrame& mesh) {
  TrajectoryOverview::Counts counts{static_cast<std::int64_t>(mesh.points.size()),
                                    static_cast<std::int64_t>(mesh.topology.cell_count()),
                                    {}};
  for (const io::VtkCell cell : mesh.topology.types) ++counts.kinds[cell];
  return counts;
}

bool read_meshes(const io::TrajectoryReader& reader, TrajectoryOverview& overview,
                 Diagnostics& diagnostics) {
  std::array<std::optional<Range>, 3> box;
  for (std::int64_t frame = 0; frame < reader.summary().frames; ++frame) {
    const auto mesh = reader.read_frame(frame, false, diagnostics);
    if (!mesh) return false;
    const auto epoch = static_cast<std::size_t>(reader.epoch_of()[static_cast<std::size_t>(frame)]);
    if (epoch >= overview.epochs.size()) overview.epochs.push_back(count(*mesh));
    for (const auto& point : mesh->points)
      for (std::size_t k = 0; k < 3; ++k)
        if (std::isfinite(point[k])) widen(box[k], point[k]);
  }
  for (std::size_t k = 0; k < 3; ++k) overview.box[k] = box[k].value_or(Range{});
  return true;
}

bool read_all_series(const io::TrajectoryReader& reader, TrajectoryOverview& overview,
                     Diagnostics& diagnostics) {
  const auto& columns = reader.run().series;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto values = reader.read_series(i, diagnostics);
    if (!values) return false;
    TrajectoryOverview::Series series{columns[i], {}, {}};
    const auto width = static_cast<std::ptrdiff_t>(columns[i].components);
    if (std::ssize(*values) >= width) {
      series.first.assign(values->begin(), values->begin() + width);
      series.last.assign(values->end() - width, values->end());
    }
    overview.series.push_back(std::move(series));
  }
  return true;
}

}  // namespace

std::optional<TrajectoryOverview> read_overview(const io::TrajectoryReader& reader,
                                                Diagnostics& diagnostics) {
  TrajectoryOverview overview;
  if (!read_meshes(reader, overview, diagnostics) || !read_fields(reader, overview, diagnostics) ||
      !read_all_series(reader, overview, diagnostics))
    return std::nullopt;
  return overview;
}

std::string cell_name(io::VtkCell cell, std::int64_t count) {
  using io::VtkCell;
  const auto name = [count](const char* one, const char* many) { return count == 1 ? one : many; };
  switch (cell) {
    case VtkCell::Vertex: return name("vertex", "vertices");
    case VtkCell::Line: return name("edge", "edges");
    case VtkCell::Triangle: return name("triangle", "triangles");
    case VtkCell::Polygon: return name("polygon", "polygons");
    case VtkCell::Quad: return name("quad", "quads");
    case VtkCell::Tetrahedron: return name("tetrahedron", "tetrahedra");
    case VtkCell::Hexahedron: return name("hexahedron", "hexahedra");
    case VtkCell::Wedge: return name("wedge", "wedges");
    case VtkCell::Pyramid: return name("pyramid", "pyramids");
    case VtkCell::Polyhedron: return name("polyhedron", "polyhedra");
  }
  return "";
}

}  // namespace gmsim::cli
