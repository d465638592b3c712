// SPDX-License-Identifier: MIT
#include "scene/file_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "support/sort_once.h"
#include "support/check.h"

namespace gmsim::scene {

namespace {

using support::DiagnosticKind;
using support::Diagnostics;
using support::Severity;

/// Groups with larger numbers keep their number but not their name: names are a table by number.
constexpr std::int32_t kLastNamedRegion = 65535;
constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);

/// "12 tetrahedra, 3 prisms" of the cells that `wanted` accepts.
template <class Wanted>
std::string counted(const FileMesh& mesh, Wanted&& wanted) {
  std::map<std::string, std::size_t> counts;
  for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
    if (!wanted(mesh.kinds[cell])) continue;
    switch (mesh.kinds[cell]) {
      case CellKind::Segment:
        ++counts["segments"];
        break;
      case CellKind::Polygon: {
        const std::size_t corners = mesh.corner_count(cell);
        ++counts[corners == 3 ? "triangles" : corners == 4 ? "quads" : "polygons"];
        break;
      }
      case CellKind::Tetrahedron:
        ++counts["tetrahedra"];
        break;
      case CellKind::Hexahedron:
        ++counts["hexahedra"];
        break;
      case CellKind::Prism:
        ++counts["prisms"];
        break;
      case CellKind::Pyramid:
        ++counts["pyramids"];
        break;
    }
  }
  std::string text;
  for (const auto& [name, count] : counts) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name);
  }
  return text;
}

int chosen_dimension(const FileMesh& mesh, int asked) {
  if (asked != 0) return asked;
  int dimension = 0;
  for (CellKind kind : mesh.kinds) dimension = std::max(dimension, dimension_of(kind));
  return dimension;
}

void warn(Diagnostics& diagnostics, DiagnosticKind kind, std::string message) {
  diagnostics.report({.kind = kind, .message = std::move(message), .severity = Severity::Warning});
}

/// The columns that have a value for every kept row, `place[r]` being where row r goes; a later
/// column of the same name replaces an earlier one.
std::vector<MeshColumn> full_columns(const std::vector<FileColumn>& given,
                                     const std::vector<std::size_t>& place, std::size_t kept,
                                     const std::string& file, Diagnostics& diagnostics) {
  std::map<std::string, MeshColumn> columns;
  for (const FileColumn& column : given) {
    std::vector<std::size_t> source(column.rows.size() < kept ? 0 : kept, kNowhere);
    std::size_t found = 0;
    for (std::size_t i = 0; i < column.rows.size(); ++i) {
      const std::size_t to = place[column.rows[i]];
      if (to == kNowhere) continue;
      ++found;
      if (!source.empty()) source[to] = i;
    }
    if (found == 0) continue;
    if (source.empty() || std::count(source.begin(), source.end(), kNowhere) > 0) {
      warn(diagnostics, DiagnosticKind::MeshFormat,
           fmt::format("{}: data `{}` is given for a part of the mesh only and is left out", file,
                       column.name));
      continue;
    }
    MeshColumn& full = columns[column.name] = {column.name, column.components, {}};
    for (std::size_t row : source) {
      const auto values =
          column.values.begin() + static_cast<std::ptrdiff_t>(row * column.components);
      full.values.insert(full.values.end(), values, values + column.components);
    }
  }
  std::vector<MeshColumn> result;
  for (auto& [name, column] : columns) result.push_back(std::move(column));
  return result;
}

void keep_regions(const FileMesh& from, const std::vector<std::size_t>& kept,
                  const std::string& file, gmap::Mesh& to, Diagnostics& diagnostics) {
  const auto grouped = [&](std::size_t cell) { return from.regions[cell] != 0; };
  if (std::none_of(kept.begin(), kept.end(), grouped)) return;
  to.regions.reserve(kept.size());
  for (std::size_t cell : kept) to.regions.push_back(from.regions[cell]);
  for (const auto& [key, name] : from.region_names) {
    const auto [dimension, number] = key;
    if (dimension != to.dimension) continue;
    if (number < 0 || number > kLastNamedRegion) {
      warn(diagnostics, DiagnosticKind::MeshFormat,
           fmt::format("{}: group {} keeps its number only; groups up to {} can have a name (`{}`)",
                       file, number, kLastNamedRegion, name));
      continue;
    }
    if (to.region_names.size() <= static_cast<std::size_t>(number)) {
      to.region_names.resize(static_cast<std::size_t>(number) + 1);
    }
    to.region_names[static_cast<std::size_t>(number)] = name;
  }
}

/// `place[cell]`: where a cell of the file goes.
std::vector<MeshGroup> groups_of(const FileMesh& mesh, const std::vector<std::size_t>& place) {
  std::map<std::string, MeshGroup> groups;
  for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
    const std::int32_t number = mesh.regions[cell];
    if (number == 0) continue;
    const auto named = mesh.region_names.find({dimension_of(mesh.kinds[cell]), number});
    MeshGroup& group = groups[named == mesh.region_names.end() ? fmt::format("group {}", number)
                                                               : named->second];
    const auto corners = mesh.corners.begin();
    group.points.insert(group.points.end(), corners + static_cast<std::ptrdiff_t>(mesh.begin[cell]),
                        corners + static_cast<std::ptrdiff_t>(mesh.begin[cell + 1]));
    if (place[cell] != kNowhere) group.cells.push_back(static_cast<std::uint32_t>(place[cell]));
  }
  std::vector<MeshGroup> result;
  for (auto& [name, group] : groups) {
    group.name = name;
    support::sort_once(group.points);
    support::sort_once(group.cells);
    result.push_back(std::move(group));
  }
  return result;
}

gmap::Mesh kept_cells(const FileMesh& from, const std::vector<std::size_t>& kept, int dimension) {
  gmap::Mesh to;
  to.dimension = dimension;
  to.kinds.reserve(kept.size());
  to.cell_begin.reserve(kept.size() + 1);
  for (std::size_t cell : kept) {
    to.kinds.push_back(from.kinds[cell]);
    const auto corners = from.corners.begin();
    to.cell_points.insert(to.cell_points.end(),
                          corners + static_cast<std::ptrdiff_t>(from.begin[cell]),
                          corners + static_cast<std::ptrdiff_t>(from.begin[cell + 1]));
    to.cell_begin.push_back(static_cast<std::uint32_t>(to.cell_points.size()));
  }
  return to;
}

}  // namespace

int dimension_of(CellKind kind) {
  switch (kind) {
    case CellKind::Segment:
      return 1;
    case CellKind::Polygon:
      return 2;
    case CellKind::Tetrahedron:
    case CellKind::Hexahedron:
    case CellKind::Prism:
    case CellKind::Pyramid:
      return 3;
  }
  return 0;
}

void FileMesh::close_cell(CellKind kind, std::int32_t region) {
  kinds.push_back(kind);
  begin.push_back(corners.size());
  regions.push_back(region);
}

std::optional<ImportedMesh> select_cells(FileMesh mesh, const MeshImportOptions& options,
                                         const std::string& file, Diagnostics& diagnostics) {
  GMSIM_CHECK(options.dimension >= 0 && options.dimension <= 3, "mesh dimension out of range");
  const int dimension = chosen_dimension(mesh, options.dimension);
  std::vector<std::size_t> kept;
  for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
    if (dimension_of(mesh.kinds[cell]) == dimension) kept.push_back(cell);
  }
  const auto other = [&](CellKind kind) { return dimension_of(kind) != dimension; };
  const std::string left_out = counted(mesh, other);
  if (kept.empty()) {
    diagnostics.report(
        {.kind = DiagnosticKind::MeshTopology,
         .message = dimension == 0
                        ? fmt::format("{}: the mesh has no cells", file)
                        : fmt::format("{}: the mesh has no cells of dimension {}", file, dimension),
         .notes =
             left_out.empty() ? std::vector<std::string>{} : std::vector{"it has " + left_out}});
    return std::nullopt;
  }
  if (mesh.corners.size() > std::numeric_limits<std::uint32_t>::max()) {
    diagnostics.report({.kind = DiagnosticKind::MeshFormat,
                        .message = fmt::format("{}: more than 2^32 corners", file)});
    return std::nullopt;
  }
  for (std::string& warning : mesh.warnings) {
    warn(diagnostics, DiagnosticKind::MeshFormat, fmt::format("{}: {}", file, warning));
  }
  if (!left_out.empty()) {
    warn(diagnostics, DiagnosticKind::MeshTopology,
         fmt::format("{}: {} left out; the mesh is made of its {}", file, left_out,
                     counted(mesh, [&](CellKind kind) { return !other(kind); })));
  }
  ImportedMesh result;
  result.mesh = kept_cells(mesh, kept, dimension);
  if (options.keep_regions) keep_regions(mesh, kept, file, result.mesh, diagnostics);
  std::vector<std::size_t> place(mesh.cell_count(), kNowhere);
  for (std::size_t i = 0; i < kept.size(); ++i) place[kept[i]] = i;
  if (options.keep_regions) result.groups = groups_of(mesh, place);
  result.cell_data = full_columns(mesh.cell_data, place, kept.size(), file, diagnostics);
  place.resize(mesh.points.size());
  std::iota(place.begin(), place.end(), std::size_t{0});
  result.point_data = full_columns(mesh.point_data, place, place.size(), file, diagnostics);
  result.mesh.points = std::move(mesh.points);
  return result;
}

}  // namespace gmsim::scene
