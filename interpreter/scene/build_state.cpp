// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "engine/apply_change.h"
#include "gmap/cell_measure.h"
#include "gmap/cell_order.h"
#include "gmap/mesh.h"
#include "gmap/orbit_walk.h"
#include "scene/build_scene.h"
#include "scene/mesh_state.h"

namespace gmsim::scene {
namespace {

using gmap::DartId;
using gmap::Row;
using support::DiagnosticKind;
using support::Severity;

/// Adds a body's mesh to that of all bodies.
void append(const gmap::Mesh& body, gmap::Mesh& all) {
  const auto first = static_cast<std::uint32_t>(all.points.size());
  all.points.insert(all.points.end(), body.points.begin(), body.points.end());
  std::vector<std::uint32_t> corners;
  for (std::size_t cell = 0; cell < body.cell_count(); ++cell) {
    corners.clear();
    for (const std::uint32_t point : body.corners(cell)) corners.push_back(first + point);
    all.add_cell(body.kinds[cell], corners);
  }
}

/// What is odd about the meshes, each body in its own numbers.
void report_problems(const Building& building) {
  for (const BodyPlan& body : building.plan.bodies) {
    const gmap::MeshMap map = gmap::build_map(body.mesh);
    for (const gmap::MeshProblem& problem : map.problems)
      building.report(DiagnosticKind::MeshTopology, body.span,
                      fmt::format("mesh of `{}`: {}", body.name, problem.message), "",
                      problem.fatal ? Severity::Error : Severity::Warning);
  }
}

void use_columns(Building& building) {
  for (const types::EmbeddingId id : building.reads) {
    const gmap::EmbeddingDecl& declaration = building.scene.program.schema[id];
    if (declaration.role == gmap::EmbeddingRole::Data &&
        declaration.kind != gmap::EmbeddingKind::Derived)
      building.state().use(id);
  }
}

void merge_meshes(Building& building) {
  building.mesh.dimension = building.plan.dimension;
  for (const BodyPlan& body : building.plan.bodies) {
    building.first_point.push_back(static_cast<std::uint32_t>(building.mesh.points.size()));
    building.first_cell.push_back(static_cast<std::uint32_t>(building.mesh.cell_count()));
    append(body.mesh, building.mesh);
  }
}

void find_bodies_of_darts(Building& building, std::uint32_t darts) {
  building.dart_body.resize(darts);
  for (std::uint32_t dart = 0; dart < darts; ++dart) {
    const auto after = std::ranges::upper_bound(building.first_cell, building.mesh_dart_cell[dart]);
    building.dart_body[dart] = static_cast<std::uint32_t>(after - building.first_cell.begin() - 1);
  }
}

/// The mass of each corner of each cell of a body with a density.
std::vector<double> corner_shares(const Building& building, std::size_t body) {
  const BodyPlan& plan = building.plan.bodies[body];
  std::vector<double> shares;
  double whole = 0;
  for (std::size_t cell = 0; cell < plan.mesh.cell_count(); ++cell) {
    shares.push_back(gmap::cell_measure(plan.mesh, cell));
    whole += shares.back();
  }
  const double density = plan.mass_kind == BodyPlan::Mass::Total ? plan.mass / whole : plan.mass;
  for (std::size_t cell = 0; cell < shares.size(); ++cell)
    shares[cell] *= density / static_cast<double>(plan.mesh.corners(cell).size());
  return shares;
}

/// Equal shares of each vertex's mass for its corners.
void share_vertex_masses(Building& building, std::size_t body) {
  const SceneExpression& expression = building.plan.bodies[body].mass_of_vertex;
  const types::EmbeddingId corner_mass = building.embedding("corner_mass");
  const types::OrbitType corner = building.scene.program.schema[corner_mass].orbit;
  const types::OrbitType vertex = types::OrbitType::cell(0, building.plan.dimension);
  DartEvaluator evaluator(building);
  std::vector<double> mass;
  for (const DartId dart : gmap::all_orbits(building.state().map, vertex)) {
    if (!building.in_body(dart, body)) continue;
    if (!evaluator.evaluate(expression, dart, mass)) return;
    if (mass[0] < 0) {
      building.report(
          DiagnosticKind::OutOfRange, expression.span,
          fmt::format("the mass is {} kg at {}", mass[0], dart_text(building.state(), dart)));
      return;
    }
    const auto corners = gmap::quotient(building.state().map, vertex, corner, dart);
    const double share = mass[0] / static_cast<double>(corners.size());
    for (const DartId c : corners) building.state().store.set(corner_mass, c, {&share, 1});
  }
}

}  // namespace

bool build_state(Building& building) {
  merge_meshes(building);
  gmap::MeshMap built = gmap::build_map(building.mesh, gmap::cell_order(building.mesh));
  if (!built.problems.empty()) report_problems(building);
  if (built.failed() || building.diagnostics.has_errors()) return false;
  building.mesh_dart_point = std::move(built.dart_point);
  building.mesh_dart_cell = std::move(built.dart_cell);
  find_bodies_of_darts(building, built.map.dart_end());
  building.scene.state =
      std::make_unique<engine::State>(building.scene.program, std::move(built.map));
  building.state().seed = building.scene.seed;
  use_columns(building);
  set_positions(building.state(), building.mesh, building.mesh_dart_point);
  return true;
}

void set_masses(Building& building) {
  const types::EmbeddingId corner_mass = building.embedding("corner_mass");
  gmap::EmbeddingColumn& column = building.state().store.use(corner_mass);
  const gmap::OrbitIndex& corners = building.state().store.index_of(corner_mass);
  std::vector<std::vector<double>> shares(building.plan.bodies.size());
  for (std::size_t body = 0; body < shares.size(); ++body)
    if (building.plan.bodies[body].mass_kind != BodyPlan::Mass::PerVertex)
      shares[body] = corner_shares(building, body);
  for (Row row = 0; row < corners.row_end(); ++row) {
    const std::uint32_t dart = types::index(corners.smallest(row));
    const std::uint32_t body = building.dart_body[dart];
    if (shares[body].empty()) continue;
    column.set(row, {&shares[body][building.mesh_dart_cell[dart] - building.first_cell[body]], 1});
  }
  for (std::size_t body = 0; body < shares.size(); ++body)
    if (building.plan.bodies[body].mass_kind == BodyPlan::Mass::PerVertex)
      share_vertex_masses(building, body);
}

void set_mesh_data(Building& building) {
  for (std::size_t body = 0; body < building.plan.bodies.size(); ++body) {
    for (const MeshData& data : building.plan.bodies[body].data) {
      const gmap::EmbeddingDecl& declaration = building.scene.program.schema[data.embedding];
      const std::size_t width = types::component_count(declaration.type);
      const auto& row_of_dart = data.of_points ? building.mesh_dart_point : building.mesh_dart_cell;
      const auto& first = data.of_points ? building.first_point : building.first_cell;
      building.state().use(data.embedding);
      for (const DartId dart : gmap::all_orbits(building.state().map, declaration.orbit)) {
        if (!building.in_body(dart, body)) continue;
        const std::size_t row = row_of_dart[types::index(dart)] - first[body];
        building.state().store.set(data.embedding, dart, {&data.values[row * width], width});
      }
    }
  }
}

// ---- prepare ------------------------------------------------------------------------------------

namespace {

class Preparer {
 public:
  explicit Preparer(Building& building) : building_(building), rewriter_(building.state()) {}

  void run(std::size_t body) {
    for (const Preparation& preparation : building_.plan.bodies[body].prepare) {
      std::uint64_t applied = 0;
      for (std::int64_t time = 0; time < preparation.times; ++time) {
        const engine::RewriteOutcome outcome = apply(preparation, body);
        building_.dart_body.resize(building_.state().map.dart_end(),
                                   static_cast<std::uint32_t>(body));
        applied += outcome.effects.applications;
        if (!failed(outcome, preparation, body)) continue;
        return;
      }
      if (applied == 0)
        building_.report(DiagnosticKind::EmptySelection, preparation.span,
                         fmt::format("`{}` applies nowhere in `{}`", preparation.name,
                                     building_.plan.bodies[body].name),
                         "", Severity::Warning);
    }
  }

 private:
  engine::RewriteOutcome apply(const Preparation& preparation, std::size_t body) {
    std::vector<DartId> darts;
    DartEvaluator evaluator(building_);
    for (const DartId dart : gmap::all_orbits(building_.state().map, preparation.to))
      if (building_.in_body(dart, body) && evaluator.holds(preparation.where, dart))
        darts.push_back(dart);
    if (evaluator.failed()) return {};
    return engine::apply_change(rewriter_, preparation.change, darts, preparation.arguments);
  }

  bool failed(const engine::RewriteOutcome& outcome, const Preparation& preparation,
              std::size_t body) {
    if (outcome.error && outcome.status == engine::RewriteOutcome::Status::Failed) {
      support::Diagnostic problem = *outcome.error;
      problem.notes.push_back(fmt::format("while `{}` prepares `{}`", preparation.name,
                                          building_.plan.bodies[body].name));
      building_.diagnostics.report(std::move(problem));
    }
    return building_.diagnostics.has_errors();
  }

  Building& building_;
  engine::Rewriter rewriter_;
};

}  // namespace

void prepare_bodies(Building& building) {
  const bool any = std::ranges::any_of(building.plan.bodies,
                                       [](const BodyPlan& body) { return !body.prepare.empty(); });
  if (!any) return;
  Preparer preparer(building);
  for (std::size_t body = 0;
       body < building.plan.bodies.size() && !building.diagnostics.has_errors(); ++body)
    preparer.run(body);
}

}  // namespace gmsim::scene
