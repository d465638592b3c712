// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "gmap/orbit_walk.h"
#include "scene/build_scene.h"

namespace gmsim::scene {
namespace {

using gmap::DartId;
using gmap::Row;
using support::DiagnosticKind;
using support::Severity;

/// One dart, the smallest, of each chosen orbit, ascending.
std::vector<DartId> chosen(const Building& building, types::OrbitType orbit,
                           const SceneExpression& where, std::optional<std::size_t> body) {
  DartEvaluator evaluator(building);
  std::vector<DartId> darts;
  for (const DartId dart : gmap::all_orbits(building.state().map, orbit))
    if (building.in_body(dart, body) && evaluator.holds(where, dart)) darts.push_back(dart);
  return darts;
}

std::vector<DartId> chosen_vertices(const Building& building, const Selection& selection) {
  const types::OrbitType vertex = types::OrbitType::cell(0, building.plan.dimension);
  std::vector<DartId> darts = chosen(building, vertex, selection.where, selection.body);
  if (darts.empty() && !building.diagnostics.has_errors())
    building.report(DiagnosticKind::EmptySelection, selection.span, "this holds at no vertex",
                    "it is judged on the bodies as built, before `initial`", Severity::Warning);
  return darts;
}

/// A vertex is held or moved, not both, and moved by one motion.
class Claims {
 public:
  explicit Claims(const Building& building) : building_(building) {}

  void claim(DartId dart, const Selection& by, bool may_repeat) {
    const auto [other, fresh] = owners_.emplace(dart, &by);
    if (fresh || (may_repeat && !other->second.moved)) {
      if (fresh) other->second.moved = !may_repeat;
      return;
    }
    building_.diagnostics.report(
        {.kind = DiagnosticKind::Conflict,
         .message =
             fmt::format("the vertex of {} is {}", dart_text(building_.state(), dart),
                         other->second.moved ? "moved by two prescriptions" : "fixed and moved"),
         .place = by.span,
         .related = {{other->second.by->span, "the other one"}}});
  }

 private:
  struct Owner {
    explicit Owner(const Selection* selection) : by(selection) {}
    const Selection* by;
    bool moved = false;
  };
  const Building& building_;
  std::unordered_map<DartId, Owner> owners_;
};

void fix(Building& building, Claims& claims) {
  for (const FixPlan& plan : building.plan.fixes) {
    const types::EmbeddingId fixed = building.embedding("fixed");
    const double yes = 1;
    for (const DartId dart : chosen_vertices(building, plan.vertices)) {
      claims.claim(dart, plan.vertices, true);
      const bool already = building.state().store.get(fixed, dart)[0] != 0;
      building.state().store.set(fixed, dart, {&yes, 1});
      if (!already && plan.on_split != engine::OnSplit::Both)
        building.scene.model.holds.push_back({dart, plan.on_split});
    }
  }
}

}  // namespace

void select_vertices(Building& building) {
  Claims claims(building);
  fix(building, claims);
  for (const MovePlan& plan : building.plan.moves) {
    engine::PrescribedMotion motion{.vertices = chosen_vertices(building, plan.vertices),
                                    .gives_position = plan.gives_position,
                                    .expression = plan.value.code,
                                    .span = plan.value.span};
    for (const DartId dart : motion.vertices) {
      claims.claim(dart, plan.vertices, false);
      if (building.diagnostics.has_errors()) return;  // one vertex says it
    }
    if (!motion.vertices.empty()) building.scene.model.motions.push_back(std::move(motion));
  }
}

void set_initial_values(Building& building) {
  const gmap::EmbeddingSchema& schema = building.scene.program.schema;
  for (std::size_t body = 0; body < building.plan.bodies.size(); ++body) {
    for (const InitialValues& initial : building.plan.bodies[body].initial) {
      // all expressions of an entry read the state before it
      std::vector<std::tuple<types::EmbeddingId, DartId, std::vector<double>>> values;
      DartEvaluator evaluator(building);
      bool anywhere = initial.values.empty();
      for (const auto& [id, expression] : initial.values)
        for (const DartId dart : chosen(building, schema[id].orbit, initial.where, body)) {
          std::vector<double> value;
          if (!evaluator.evaluate(expression, dart, value)) return;
          values.emplace_back(id, dart, std::move(value));
          anywhere = true;
        }
      if (!anywhere && !building.diagnostics.has_errors())
        building.report(DiagnosticKind::EmptySelection, initial.where.span,
                        fmt::format("this holds nowhere in `{}`", building.plan.bodies[body].name),
                        "positions here are those that earlier entries of `initial` have set",
                        Severity::Warning);
      for (const auto& [id, dart, value] : values) building.state().store.set(id, dart, value);
    }
  }
}

// ---- points -------------------------------------------------------------------------------------

namespace {

constexpr std::uint32_t kNoPoint = 0xffffffffu;

/// The point of each vertex row. A vertex has the point of its oldest dart that came from the mesh;
/// vertices that have none left, because a rule made them or another part took the point, are
/// numbered behind, in the order of their smallest darts.
std::vector<std::uint32_t> points_of_rows(const Building& building,
                                          const gmap::OrbitIndex& vertices) {
  std::vector<std::uint32_t> points(vertices.row_end(), kNoPoint);
  std::vector<bool> taken(building.mesh.points.size(), false);
  for (std::uint32_t dart = 0; dart < building.mesh_dart_point.size(); ++dart) {
    const std::uint32_t point = building.mesh_dart_point[dart];
    if (!building.state().map.alive(DartId{dart}) || taken[point]) continue;
    std::uint32_t& place = points[vertices.row(DartId{dart})];
    if (place != kNoPoint) continue;
    place = point;
    taken[point] = true;
  }
  auto next = static_cast<std::uint32_t>(building.mesh.points.size());
  std::vector<std::pair<DartId, Row>> unnamed;
  for (Row row = 0; row < vertices.row_end(); ++row)
    if (vertices.alive(row) && points[row] == kNoPoint)
      unnamed.emplace_back(vertices.smallest(row), row);
  std::ranges::sort(unnamed);
  for (const auto& [dart, row] : unnamed) points[row] = next++;
  return points;
}

void find_expected_points(Building& building, const std::vector<DartId>& dart_of_point) {
  Scene& scene = building.scene;
  for (std::size_t i = 0; i < scene.expectations.size(); ++i) {
    const ExpectedPoint& wanted = building.plan.expected[i];
    const std::size_t body = wanted.body.value_or(0);
    const std::uint32_t first = building.first_point[body];
    const auto count = static_cast<std::int64_t>(building.plan.bodies[body].mesh.points.size());
    // Numbers behind the mesh's points are those that `prepare` made, in the whole scene.
    const std::int64_t number = wanted.point.value_or(0) < count || building.plan.bodies.size() > 1
                                    ? first + wanted.point.value_or(0)
                                    : wanted.point.value_or(0);
    const bool outside = wanted.point && building.plan.bodies.size() > 1 && *wanted.point >= count;
    const bool known = !outside && number < static_cast<std::int64_t>(dart_of_point.size()) &&
                       dart_of_point[static_cast<std::size_t>(number)] != gmap::kNoDart;
    if (known) {
      scene.expectations[i].dart = dart_of_point[static_cast<std::size_t>(number)];
    } else if (wanted.point) {
      building.report(
          DiagnosticKind::OutOfRange, wanted.span,
          fmt::format("`{}` has no point {}", building.plan.bodies[body].name, *wanted.point),
          fmt::format("its points are numbered from 0 to {}", count - 1));
    } else {
      scene.expectations[i].dart = scene.bodies[body].vertices.at(0);
    }
  }
}

}  // namespace

void number_points(Building& building) {
  Scene& scene = building.scene;
  const gmap::GMap& map = building.state().map;
  const gmap::OrbitIndex& vertices =
      building.state().store.use_index(types::OrbitType::cell(0, building.plan.dimension));
  const std::vector<std::uint32_t> points = points_of_rows(building, vertices);
  scene.dart_point.assign(map.dart_end(), kNoPoint);
  std::vector<DartId> dart_of_point;
  for (std::uint32_t dart = 0; dart < map.dart_end(); ++dart) {
    if (!map.alive(DartId{dart})) continue;
    const std::uint32_t point = points[vertices.row(DartId{dart})];
    scene.dart_point[dart] = point;
    if (point >= dart_of_point.size()) dart_of_point.resize(point + std::size_t{1}, gmap::kNoDart);
    if (dart_of_point[point] == gmap::kNoDart) dart_of_point[point] = DartId{dart};
  }
  for (std::size_t body = 0; body < building.plan.bodies.size(); ++body)
    scene.bodies.push_back({building.plan.bodies[body].name, {}, 0});
  for (const DartId dart : dart_of_point)
    if (dart != gmap::kNoDart)
      scene.bodies[building.dart_body[types::index(dart)]].vertices.push_back(dart);
  for (const DartId cell :
       gmap::all_orbits(map, types::OrbitType::range(0, building.plan.dimension - 1)))
    ++scene.bodies[building.dart_body[types::index(cell)]].cells;
  find_expected_points(building, dart_of_point);
}

}  // namespace gmsim::scene
