// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "engine/tree_eval.h"
#include "scene/plan.h"
#include "scene/scene.h"

/// From a checked scene to a state at time 0.
namespace gmsim::scene {

/// What the steps of building share.
struct Building {
  Scene& scene;
  ScenePlan& plan;
  support::Diagnostics& diagnostics;

  gmap::Mesh mesh = {};                         ///< all bodies, one after another
  std::vector<std::uint32_t> first_point = {};  ///< of each body
  std::vector<std::uint32_t> first_cell = {};
  std::vector<std::uint32_t> mesh_dart_point = {}, mesh_dart_cell = {};  ///< as gmap::MeshMap
  std::vector<std::uint32_t> dart_body = {};                             ///< by dart
  std::set<types::EmbeddingId> reads = {};  ///< what some part of the scene reads

  [[nodiscard]] engine::State& state() const { return *scene.state; }
  [[nodiscard]] bool in_body(gmap::DartId dart, std::optional<std::size_t> body) const {
    return !body || dart_body[types::index(dart)] == *body;
  }
  [[nodiscard]] types::EmbeddingId embedding(const char* name) const;
  void report(support::DiagnosticKind kind, std::optional<support::Span> place, std::string message,
              std::string help = {}, support::Severity severity = support::Severity::Error) const;
};

/// Evaluates expressions of the scene at darts; the first failure is reported, and everything after
/// it fails in silence.
class DartEvaluator {
 public:
  explicit DartEvaluator(const Building& building);

  /// An optional value that is missing makes a condition false.
  [[nodiscard]] bool holds(const SceneExpression& condition, gmap::DartId dart);
  /// Finite numbers; false after a failure.
  [[nodiscard]] bool evaluate(const SceneExpression& expression, gmap::DartId dart,
                              std::vector<double>& out);
  [[nodiscard]] bool failed() const { return failed_; }

 private:
  const Building& building_;
  engine::TreeEvaluator evaluator_;
  engine::Frame frame_;
  bool failed_ = false;
};

/// "dart 12 at (0.5, 1, 0)", for messages.
[[nodiscard]] std::string dart_text(const engine::State& state, gmap::DartId dart);

/// Everything below, in order. False after an error.
bool build_scene(Scene& scene, ScenePlan& plan, support::Diagnostics& diagnostics);

/// The map of all bodies, their positions and columns for what `reads` names.
bool build_state(Building& building);
/// Values from the mesh files.
void set_mesh_data(Building& building);
void set_masses(Building& building);
void prepare_bodies(Building& building);
/// Marks and parameters of interactions; fills the model.
void bind_interactions(Building& building);
void select_vertices(Building& building);
void set_initial_values(Building& building);
/// Numbers of points, summaries, the darts of expectations.
void number_points(Building& building);

/// Every embedding that some part of the scene reads or must have.
[[nodiscard]] std::set<types::EmbeddingId> embeddings_read(const Scene& scene,
                                                           const ScenePlan& plan);
/// What rules that act during the run write.
[[nodiscard]] std::set<types::EmbeddingId> embeddings_written(const Scene& scene);

}  // namespace gmsim::scene
