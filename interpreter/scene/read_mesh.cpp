// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "gmap/mesh_builders.h"
#include "scene/import_mesh.h"
#include "scene/read_context.h"

namespace gmsim::scene {
namespace {

using gmap::Mesh;
using support::DiagnosticKind;

/// Darts are numbered by 32 bits, and a cell has up to 48.
constexpr double kMostCells = 5e7;

template <typename Kind, std::size_t N>
Kind kind_of(const YamlNode& node, const std::pair<const char*, Kind> (&kinds)[N]) {
  const auto found =
      std::ranges::find(kinds, node.text, [](const auto& kind) { return std::string(kind.first); });
  return found == std::end(kinds) ? kinds[0].second : found->second;
}

std::vector<double> numbers(const YamlNode& node, ReadContext& context) {
  std::vector<double> result;
  for (const YamlNode& item : node.items) result.push_back(context.number(item));
  return result;
}

/// The counts along each axis; empty when they are more cells than fit.
std::optional<std::vector<std::uint32_t>> counts(const YamlNode& node, ReadContext& context) {
  double product = 1;
  std::vector<std::uint32_t> result;
  for (const double count :
       node.is_list() ? numbers(node, context) : std::vector<double>{context.number(node)}) {
    product *= count;
    if (product > kMostCells) {
      context.report(DiagnosticKind::OutOfRange, node.span,
                     fmt::format("these are more than {:.0f} cells", kMostCells));
      return std::nullopt;
    }
    result.push_back(static_cast<std::uint32_t>(count));
  }
  return result;
}

/// Builders make maps of one dimension.
bool fits(const YamlNode& node, const char* what, int made, ReadContext& context) {
  if (made == context.dimension()) return true;
  context.report(DiagnosticKind::Dimension, node.span,
                 fmt::format("a {} is of dimension {}, this scene of dimension {}", what, made,
                             context.dimension()));
  return false;
}

std::optional<Mesh> read_grid(const YamlNode& node, ReadContext& context) {
  static constexpr std::pair<const char*, gmap::GridCells> kKinds[] = {
      {"quads", gmap::GridCells::Quads},
      {"triangles", gmap::GridCells::Triangles},
      {"tri4", gmap::GridCells::Tri4},
      {"mix2", gmap::GridCells::Mix2},
      {"mix4", gmap::GridCells::Mix4}};
  if (!fits(node, "grid", 2, context) || !node.find("patches")) return std::nullopt;
  const auto patches = counts(*node.find("patches"), context);
  const auto size = numbers(*node.find("size"), context);
  if (!patches) return std::nullopt;
  return gmap::grid((*patches)[0], (*patches)[1], size[0], size[1],
                    kind_of(*node.find("cells"), kKinds));
}

std::optional<Mesh> read_box(const YamlNode& node, ReadContext& context) {
  static constexpr std::pair<const char*, gmap::BoxElements> kKinds[] = {
      {"hexes", gmap::BoxElements::Hexes},
      {"tets6", gmap::BoxElements::Tets6},
      {"tets5", gmap::BoxElements::Tets5}};
  if (!fits(node, "box", 3, context) || !node.find("cells")) return std::nullopt;
  const auto cells = counts(*node.find("cells"), context);
  const auto size = numbers(*node.find("size"), context);
  if (!cells) return std::nullopt;
  return gmap::box({(*cells)[0], (*cells)[1], (*cells)[2]}, {size[0], size[1], size[2]},
                   kind_of(*node.find("elements"), kKinds));
}

std::optional<Mesh> read_chain(const YamlNode& node, ReadContext& context) {
  if (!fits(node, "chain", 1, context) || !node.find("segments")) return std::nullopt;
  const auto segments = counts(*node.find("segments"), context);
  if (!segments) return std::nullopt;
  return gmap::chain((*segments)[0], context.number(*node.find("length")));
}

std::optional<ImportedMesh> read_file(const YamlNode& node, ReadContext& context) {
  support::Diagnostics found;
  auto mesh = import_mesh_with_data(context.folder / node.text, {.dimension = context.dimension()}, found);
  for (support::Diagnostic diagnostic : found.all()) {
    if (!diagnostic.place) diagnostic.place = node.span;
    context.diagnostics.report(std::move(diagnostic));
  }
  return mesh;
}

std::optional<Mesh::CellKind> cell_kind(int dimension, std::size_t corners) {
  if (dimension == 1 && corners == 2) return Mesh::CellKind::Segment;
  if (dimension == 2 && corners >= 3) return Mesh::CellKind::Polygon;
  if (dimension != 3) return std::nullopt;
  switch (corners) {
    case 4:
      return Mesh::CellKind::Tetrahedron;
    case 5:
      return Mesh::CellKind::Pyramid;
    case 6:
      return Mesh::CellKind::Prism;
    case 8:
      return Mesh::CellKind::Hexahedron;
    default:
      return std::nullopt;
  }
}

std::optional<Mesh> read_points(const YamlNode& section, ReadContext& context) {
  Mesh mesh;
  mesh.dimension = context.dimension();
  for (const YamlNode& point : section.find("points")->items) {
    const auto at = numbers(point, context);
    mesh.points.push_back({at[0], at[1], at[2]});
  }
  bool good = true;
  for (const YamlNode& cell : section.find("cells")->items) {
    const auto kind = cell_kind(mesh.dimension, cell.items.size());
    if (!kind) {
      context.report(
          DiagnosticKind::WrongForm, cell.span,
          fmt::format("no cell of dimension {} has {} corners", mesh.dimension, cell.items.size()));
      good = false;
      continue;
    }
    std::vector<std::uint32_t> corners;
    for (const YamlNode& corner : cell.items) {
      const auto number = static_cast<std::uint64_t>(context.number(corner));
      if (number >= mesh.points.size()) {
        context.report(DiagnosticKind::OutOfRange, corner.span,
                       fmt::format("there is no point {}: they are numbered from 0 to {}", number,
                                   static_cast<std::int64_t>(mesh.points.size()) - 1));
        good = false;
        continue;
      }
      corners.push_back(static_cast<std::uint32_t>(number));
    }
    if (corners.size() == cell.items.size()) mesh.add_cell(*kind, corners);
  }
  if (!good) return std::nullopt;
  return mesh;
}

using Point = std::array<double, 3>;

/// Rodrigues' rotation of p about a unit axis.
Point rotated(const Point& p, const Point& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const double along = axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2];
  const Point cross = {axis[1] * p[2] - axis[2] * p[1], axis[2] * p[0] - axis[0] * p[2],
                       axis[0] * p[1] - axis[1] * p[0]};
  Point result{};
  for (std::size_t k = 0; k < 3; ++k)
    result[k] = c * p[k] + s * cross[k] + (1 - c) * along * axis[k];
  return result;
}

void rotate(Mesh& mesh, const YamlNode& rotation, ReadContext& context) {
  const auto axis = numbers(*rotation.find("axis"), context);
  const double length = std::hypot(axis[0], axis[1], axis[2]);
  const double angle = context.number(*rotation.find("degrees")) * std::numbers::pi / 180;
  if (length == 0) {
    context.report(DiagnosticKind::OutOfRange, rotation.find("axis")->span,
                   "an axis of no length has no direction");
    return;
  }
  if (angle == 0) return;  // leaves the last bits of positions alone
  const Point unit = {axis[0] / length, axis[1] / length, axis[2] / length};
  for (Point& point : mesh.points) point = rotated(point, unit, angle);
}

void place(Mesh& mesh, const YamlNode& placing, ReadContext& context) {
  const double scale = context.number(*placing.find("scale"));
  for (Point& point : mesh.points)
    for (double& coordinate : point) coordinate *= scale;
  if (const YamlNode* rotation = placing.find("rotate")) rotate(mesh, *rotation, context);
  const auto shift = numbers(*placing.find("translate"), context);
  for (Point& point : mesh.points)
    for (std::size_t k = 0; k < 3; ++k) point[k] += shift[k];
}

/// Was something wrong in this part of the scene?
bool reported_within(support::Span span, const ReadContext& context) {
  return std::ranges::any_of(context.diagnostics.all(), [&](const support::Diagnostic& problem) {
    return problem.place && problem.place->file == span.file && problem.place->begin >= span.begin &&
           problem.place->end <= span.end;
  });
}

/// The one key of a mesh that says where it comes from; empty (reported) when it is not one.
const YamlEntry* source_of(const YamlNode& mesh, ReadContext& context) {
  const YamlEntry* source = nullptr;
  for (const YamlEntry& entry : mesh.entries) {
    if (entry.key == "cells" || entry.value.is_null()) continue;
    if (source != nullptr) {
      context.report(DiagnosticKind::Conflict, entry.key_span,
                     fmt::format("the mesh comes from `{}` already", source->key),
                     "leave one of them out");
      return nullptr;
    }
    source = &entry;
  }
  const bool cells = mesh.find("cells") != nullptr;
  if (source != nullptr && cells == (source->key == "points")) return source;
  if (reported_within(mesh.span, context)) return nullptr;  // what is wrong was taken out
  if (source == nullptr || source->key == "points")
    context.report(DiagnosticKind::MissingKey, mesh.span,
                   cells    ? "`cells` need `points`"
                   : source ? "`points` need `cells`"
                            : "this does not say where the mesh comes from",
                   "give one of `grid`, `box`, `chain`, `file`, or `points` with `cells`");
  else
    context.report(DiagnosticKind::Conflict, mesh.find_entry("cells")->key_span,
                   fmt::format("`cells` belong to `points`, this mesh is a `{}`", source->key));
  return nullptr;
}

std::optional<ImportedMesh> without_data(std::optional<Mesh> mesh) {
  if (!mesh) return std::nullopt;
  return ImportedMesh{std::move(*mesh), {}, {}};
}

}  // namespace

std::optional<ImportedMesh> read_mesh(const YamlNode& body, ReadContext& context) {
  const YamlNode* node = body.find("mesh");
  if (node == nullptr) return std::nullopt;
  const YamlEntry* source = source_of(*node, context);
  if (source == nullptr) return std::nullopt;
  const YamlNode& value = source->value;
  std::optional<ImportedMesh> read =
      source->key == "grid"    ? without_data(read_grid(value, context))
      : source->key == "box"   ? without_data(read_box(value, context))
      : source->key == "chain" ? without_data(read_chain(value, context))
      : source->key == "file"  ? read_file(value, context)
                               : without_data(read_points(*node, context));
  if (const YamlNode* placing = body.find("place"); read && placing != nullptr)
    place(read->mesh, *placing, context);
  return read;
}

}  // namespace gmsim::scene
