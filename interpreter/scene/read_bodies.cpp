// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/import_mesh.h"
#include "scene/quantity.h"
#include "scene/read_context.h"
#include "scene/schema.h"
#include "support/suggest.h"

namespace gmsim::scene {
namespace {

using support::DiagnosticKind;

void read_density(const YamlNode& node, ReadContext& context, BodyPlan& body) {
  static constexpr const char* kUnits[] = {"kg/m", "kg/m^2", "kg/m^3"};
  const auto density = read_quantity(node, schema_unit(kUnits[context.dimension() - 1]),
                                     context.sources, context.diagnostics);
  body.mass_kind = BodyPlan::Mass::Density;
  if (density) body.mass = density->value;
}

void read_mass(const YamlNode& node, ReadContext& context, BodyPlan& body) {
  if (node.is_scalar()) {
    body.mass = context.number(node);
    return;
  }
  const YamlNode* density = node.find("density");
  const YamlNode* per_vertex = node.find("per_vertex");
  if ((density != nullptr) == (per_vertex != nullptr)) {
    context.report(density ? DiagnosticKind::Conflict : DiagnosticKind::MissingKey, node.span,
                   density ? "the mass is given by `density` and by `per_vertex`"
                           : "this does not say what the mass is",
                   "give one of `density` and `per_vertex`, or a number for the whole body");
  } else if (density != nullptr) {
    read_density(*density, context, body);
  } else {
    body.mass_kind = BodyPlan::Mass::PerVertex;
    body.mass_of_vertex = context.expression(
        *per_vertex, {.type = {types::ValueKind::Real}, .unit = schema_unit("kg")});
  }
}

/// `position`, `velocity` or another embedding that holds data.
std::optional<types::EmbeddingId> settable(const YamlEntry& entry, ReadContext& context) {
  const gmap::EmbeddingSchema& schema = context.program.schema;
  const auto id = schema.find(entry.key);
  std::vector<std::string> names;
  for (const gmap::EmbeddingDecl& declaration : schema)
    if (declaration.role == gmap::EmbeddingRole::Data &&
        declaration.kind != gmap::EmbeddingKind::Derived)
      names.push_back(declaration.name);
  if (!id) {
    names.emplace_back("where");
    context.report(DiagnosticKind::UnknownEmbedding, entry.key_span,
                   fmt::format("no embedding named `{}`", entry.key),
                   support::did_you_mean(entry.key, names));
    return std::nullopt;
  }
  if (std::ranges::find(names, entry.key) != names.end()) return id;
  context.report(
      DiagnosticKind::BadAssignment, entry.key_span,
      fmt::format("`{}` cannot be set: it {}", entry.key,
                  schema[*id].kind == gmap::EmbeddingKind::Derived ? "is computed from other values"
                                                                   : "belongs to an interaction"));
  return std::nullopt;
}

InitialValues read_initial(const YamlNode& section, ReadContext& context) {
  InitialValues initial{.where = context.where(section)};
  for (const YamlEntry& entry : section.entries) {
    if (entry.key == "where") continue;
    const auto id = settable(entry, context);
    if (!id) continue;
    const gmap::EmbeddingDecl& declaration = context.program.schema[*id];
    initial.values.emplace_back(
        *id, context.expression(entry.value, {.type = declaration.type,
                                              .unit = declaration.unit,
                                              .unit_scale = declaration.unit_scale}));
  }
  return initial;
}

/// Numbers of a column, in SI units, as the type of the embedding has them.
bool take_values(const MeshColumn& column, const gmap::EmbeddingDecl& declaration,
                 const YamlEntry& entry, ReadContext& context, MeshData& data) {
  const std::uint32_t components = types::component_count(declaration.type);
  if (column.components != components) {
    context.report(DiagnosticKind::TypeMismatch, entry.value.span,
                   fmt::format("`{}` has {} component{}, the embedding `{}` has {}", column.name,
                               column.components, column.components == 1 ? "" : "s",
                               declaration.name, components));
    return false;
  }
  const bool whole = declaration.type.kind == types::ValueKind::Bool ||
                     declaration.type.kind == types::ValueKind::Int;
  for (const double value : column.values) {
    if (std::isfinite(value) && (!whole || value == std::floor(value))) continue;
    context.report(DiagnosticKind::NonFinite, entry.value.span,
                   fmt::format("`{}` has the value {}, `{}` needs {}", column.name, value,
                               declaration.name, whole ? "whole numbers" : "finite numbers"));
    return false;
  }
  for (const double value : column.values) data.values.push_back(value * declaration.unit_scale);
  return true;
}

/// 1 where the group is, else 0.
MeshColumn column_of(const MeshGroup& group, const ImportedMesh& mesh, bool of_points) {
  MeshColumn column{group.name, 1, {}};
  column.values.resize(of_points ? mesh.mesh.points.size() : mesh.mesh.cell_count(), 0.0);
  for (const std::uint32_t member : of_points ? group.points : group.cells)
    column.values[member] = 1;
  return column;
}

std::optional<MeshData> read_data(const YamlEntry& entry, const ImportedMesh& mesh,
                                  ReadContext& context) {
  const auto id = settable(entry, context);
  if (!id) return std::nullopt;
  const gmap::EmbeddingDecl& declaration = context.program.schema[*id];
  const int n = context.dimension();
  MeshData data{.embedding = *id,
                .of_points = declaration.orbit == types::OrbitType::cell(0, n)};
  if (!data.of_points && !types::OrbitType::cell(n, n).contains(declaration.orbit)) {
    context.report(DiagnosticKind::BadItem, entry.key_span,
                   fmt::format("`{}` is on {}, which is neither a vertex nor within an element",
                               declaration.name, types::to_string(declaration.orbit)),
                   "mesh files have data of points and of cells");
    return std::nullopt;
  }
  const std::vector<MeshColumn>& columns = data.of_points ? mesh.point_data : mesh.cell_data;
  const auto column = std::ranges::find(columns, entry.value.text, &MeshColumn::name);
  if (column == columns.end()) {
    if (const auto group = std::ranges::find(mesh.groups, entry.value.text, &MeshGroup::name);
        group != mesh.groups.end()) {
      if (!take_values(column_of(*group, mesh, data.of_points), declaration, entry, context, data))
        return std::nullopt;
      return data;
    }
    std::vector<std::string> names;
    for (const MeshColumn& known : columns) names.push_back(known.name);
    for (const MeshGroup& known : mesh.groups) names.push_back(known.name);
    const std::string guess = support::did_you_mean(entry.value.text, names);
    context.report(DiagnosticKind::UnknownName, entry.value.span,
                   fmt::format("the mesh has no data of {} and no group called `{}`",
                               data.of_points ? "points" : "cells", entry.value.text),
                   !guess.empty()  ? guess
                   : names.empty() ? "it has none"
                                   : fmt::format("it has `{}`", fmt::join(names, "`, `")));
    return std::nullopt;
  }
  if (!take_values(*column, declaration, entry, context, data)) return std::nullopt;
  return data;
}

/// The names of the bodies, given or default.
void read_names(const std::vector<YamlNode>& bodies, ReadContext& context) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const YamlNode* name = bodies[i].find("name");
    if (name == nullptr) {
      context.body_names.push_back(default_body_name(i, bodies.size()));
      continue;
    }
    if (std::ranges::find(context.body_names, name->text) != context.body_names.end())
      context.report(DiagnosticKind::DuplicateName, name->span,
                     fmt::format("two bodies are called `{}`", name->text));
    context.body_names.push_back(name->text);
  }
}

}  // namespace

void read_bodies(const YamlNode& scene, ReadContext& context, ScenePlan& plan) {
  const YamlNode* bodies = scene.find("bodies");
  if (bodies == nullptr) return;
  read_names(bodies->items, context);
  for (std::size_t i = 0; i < bodies->items.size(); ++i) {
    const YamlNode& section = bodies->items[i];
    BodyPlan body{.name = context.body_names[i], .span = section.span};
    if (const YamlEntry* mesh = section.find_entry("mesh")) body.span = mesh->key_span;
    if (auto read = read_mesh(section, context)) {
      for (const YamlEntry& entry : section.find("data")->entries)
        if (auto data = read_data(entry, *read, context)) body.data.push_back(std::move(*data));
      body.mesh = std::move(read->mesh);
    }
    if (const YamlNode* mass = section.find("mass")) read_mass(*mass, context, body);
    body.prepare = read_preparations(section, context);
    for (const YamlNode& initial : section.find("initial")->items)
      body.initial.push_back(read_initial(initial, context));
    plan.bodies.push_back(std::move(body));
  }
}

}  // namespace gmsim::scene
