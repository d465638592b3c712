// SPDX-License-Identifier: MIT
#include "scene/build_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/mesh_state.h"
#include "support/check.h"

namespace gmsim::scene {

using support::DiagnosticKind;

types::EmbeddingId Building::embedding(const char* name) const {
  const auto id = scene.program.schema.find(name);
  GMSIM_CHECK(id.has_value(), std::string("no embedding `") + name + "` in the schema");
  return *id;
}

void Building::report(DiagnosticKind kind, std::optional<support::Span> place, std::string message,
                      std::string help, support::Severity severity) const {
  diagnostics.report({.kind = kind,
                      .message = std::move(message),
                      .place = place,
                      .help = std::move(help),
                      .severity = severity});
}

DartEvaluator::DartEvaluator(const Building& building)
    : building_(building), evaluator_(building.state()) {}

bool DartEvaluator::holds(const SceneExpression& condition, gmap::DartId dart) {
  if (failed_) return false;
  const types::Expr& value = *condition.code.value;
  if (value.kind == types::ExprKind::Literal) return value.value.as_bool();
  frame_.reset(condition.code.frame_size);
  frame_.set(condition.code.dart, dart);
  bool result = false;
  if (evaluator_.evaluate_bool(value, frame_, result)) return result;
  engine::EvalFailure failure = evaluator_.take_failure();
  if (failure.missing_optional) return false;
  failed_ = true;
  failure.diagnostic.notes.push_back("at " + dart_text(building_.state(), dart));
  building_.diagnostics.report(std::move(failure.diagnostic));
  return false;
}

bool DartEvaluator::evaluate(const SceneExpression& expression, gmap::DartId dart,
                             std::vector<double>& out) {
  if (failed_) return false;
  frame_.reset(expression.code.frame_size);
  frame_.set(expression.code.dart, dart);
  out.assign(types::component_count(expression.code.value->type), 0.0);
  support::Diagnostic problem{.kind = DiagnosticKind::NonFinite,
                              .message = "this value is not finite",
                              .place = expression.span};
  if (evaluator_.evaluate(*expression.code.value, frame_, out)) {
    if (std::ranges::all_of(out, [](double x) { return std::isfinite(x); })) return true;
  } else {
    problem = evaluator_.take_failure().diagnostic;
  }
  failed_ = true;
  problem.notes.push_back("at " + dart_text(building_.state(), dart));
  building_.diagnostics.report(std::move(problem));
  return false;
}

std::string dart_text(const engine::State& state, gmap::DartId dart) {
  const auto position = state.program.schema.find("position");
  std::string text = fmt::format("dart {}", types::index(dart));
  if (!position || !state.store.in_use(*position)) return text;
  const auto at = state.store.get(*position, dart);
  return at.size() == 3 ? fmt::format("{} at ({:.6g}, {:.6g}, {:.6g})", text, at[0], at[1], at[2])
                        : text;
}

namespace {

void require_values(const Building& building) {
  for (const std::string& name : missing_embeddings(building.state()))
    building.report(DiagnosticKind::MissingValue, std::nullopt,
                    fmt::format("the scene gives no value for the embedding `{}`", name),
                    fmt::format("give it under `initial` of each body, a default in its "
                                "declaration, or make it `optional`"));
}

}  // namespace

bool build_scene(Scene& scene, ScenePlan& plan, support::Diagnostics& diagnostics) {
  Building building{scene, plan, diagnostics};
  building.reads = embeddings_read(scene, plan);
  if (!build_state(building)) return false;
  using Step = void (*)(Building&);
  for (const Step step : {set_mesh_data, set_masses, prepare_bodies, bind_interactions, select_vertices,
                          set_initial_values, number_points}) {
    step(building);
    if (diagnostics.has_errors()) return false;
  }
  require_values(building);
  return !diagnostics.has_errors();
}

}  // namespace gmsim::scene
