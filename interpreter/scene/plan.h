// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/frame.h"
#include "engine/model.h"
#include "engine/tear_model.h"
#include "gmap/mesh.h"
#include "support/span.h"
#include "types/expr.h"

/// A scene after checking and before building: names are resolved, expressions checked, meshes
/// read.
namespace gmsim::scene {

/// An expression of a scene.
struct SceneExpression {
  engine::DartExpression code = {};  ///< `value` is null after an error
  support::Span span = {};
  std::string text = {};  ///< as the rule language has it
  bool constant = false;  ///< the same everywhere and always
  bool reads_clock = false;

  [[nodiscard]] bool good() const { return code.value != nullptr; }
};

/// A parameter that a scene gives to an interaction.
struct GivenParameter {
  std::uint32_t parameter = 0;  ///< of the interaction
  SceneExpression value = {};
};
/// One interaction, or the members of a family, where the scene asks for it.
struct InteractionUse {
  struct Member {
    std::uint32_t interaction = 0;  ///< index into Program::interactions
    std::vector<GivenParameter> given = {};
  };
  std::string name = {};
  std::vector<Member> members =
      {};  ///< a family's in its order; an element takes the first that fits
  bool family = false;
  SceneExpression where = {};
  std::optional<std::size_t> body = {};  ///< empty: all of them
  support::Span span = {};               ///< the name
};

/// A rule or an operation that finishes a mesh.
struct Preparation {
  engine::NamedChange change = {};
  std::string name = {};
  types::OrbitType to = {};
  SceneExpression where = {};
  engine::Arguments arguments = {};
  std::int64_t times = 1;
  support::Span span = {};  ///< the name
};

/// Values to start from.
struct InitialValues {
  SceneExpression where = {};
  std::vector<std::pair<types::EmbeddingId, SceneExpression>> values = {};
};

/// Values of an embedding that the mesh file gives.
struct MeshData {
  types::EmbeddingId embedding{};
  bool of_points = false;              ///< else of cells
  std::vector<double> values = {};     ///< SI; components x rows, row after row
};

struct BodyPlan {
  enum class Mass : std::uint8_t { Total, Density, PerVertex };
  std::string name = {};
  support::Span span = {};  ///< the mesh, for messages about it
  gmap::Mesh mesh = {};     ///< placed
  Mass mass_kind = Mass::Total;
  double mass = 0;  ///< kg; of Density: kg per m, m^2 or m^3
  SceneExpression mass_of_vertex = {};
  std::vector<MeshData> data = {};
  std::vector<Preparation> prepare = {};
  std::vector<InitialValues> initial = {};
};

/// Vertices that a scene chooses.
struct Selection {
  std::optional<std::size_t> body = {};
  SceneExpression where = {};
  support::Span span = {};
};
struct FixPlan {
  Selection vertices = {};
  engine::OnSplit on_split = engine::OnSplit::Both;
};
struct MovePlan {
  Selection vertices = {};
  bool gives_position = false;
  SceneExpression value = {};
};
/// The point at which an expectation is judged.
struct ExpectedPoint {
  std::optional<std::size_t> body = {};
  std::optional<std::int64_t> point = {};
  support::Span span = {};
};

struct ScenePlan {
  int dimension = 2;
  std::vector<BodyPlan> bodies = {};
  std::vector<InteractionUse> interactions =
      {};  ///< in the order of the scene, gravity after the bodies'
  std::vector<FixPlan> fixes = {};
  std::vector<MovePlan> moves = {};
  std::vector<ExpectedPoint> expected = {};  ///< parallel to Scene::expectations
};

}  // namespace gmsim::scene
