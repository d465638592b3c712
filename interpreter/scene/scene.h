// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "check/check.h"
#include "compile/program.h"
#include "engine/model.h"
#include "engine/state.h"
#include "engine/tear_model.h"
#include "support/diagnostic.h"
#include "support/source_map.h"

namespace gmsim::scene {

/// A quantity that is written with every frame.
struct OutputField {
  std::string name;   ///< as it stands in the file
  std::string text;   ///< the expression, or the name of an embedding
  types::OrbitType orbit;
  types::ValueType type;
  types::MaybeUnit unit;
  engine::DartExpression value;
  support::Span span;
};

struct OutputPlan {
  std::filesystem::path file;     ///< empty: nothing is written
  double every = 0;               ///< s of simulated time between frames
  std::vector<double> at;         ///< s, further frames
  std::vector<OutputField> fields;
  double report_every = 0;        ///< s between rows of the time series; 0: with every frame
  bool sync = false;
};

/// A value that `gmsim verify` compares after (or during) the run:
/// `{ value: EXPR, at: end | TIME, equals: NUMBER | [x, y, z], within: NUMBER }`, or with
/// `at_least`, `at_most` in place of `equals`. `point: N` (and `body: NAME` if there are several)
/// says at which point of the mesh a value such as `position` is meant. Or `{ tears: NUMBER, at }`.
struct Expectation {
  bool counts_tears = false;      ///< the changes that `tear` has made are compared, not `value`
  engine::DartExpression value;   ///< real or vec3
  gmap::DartId dart = gmap::kNoDart;  ///< of the point; of the body's first where none is named
  std::string text;
  double at = 0;                  ///< s
  std::vector<double> equals;     ///< 1 or 3 numbers, or empty; with `within`
  double within = 0;              ///< absolute, for each number
  std::optional<double> at_least, at_most;
  support::Span span;
};

/// A named part of the scene, for messages and summaries.
struct BodySummary {
  std::string name;
  std::vector<gmap::DartId> vertices;  ///< one dart of each, as the mesh numbers its points
  std::size_t cells = 0;
};

/// Everything a run needs. Stays where it was made: the state refers to the program.
struct Scene {
  std::filesystem::path path;
  std::string resolved;           ///< the YAML with all defaults and overrides, runnable by itself
  check::CheckedRules rules;
  compile::Program program;
  std::unique_ptr<engine::State> state;   ///< at time 0, after `prepare`, masses, `initial`
  engine::Model model;
  engine::IntegratorSettings integrator;
  double duration = 0;            ///< s
  std::vector<double> stop_at;    ///< s, ascending
  std::uint64_t seed = 1;
  OutputPlan output;
  std::vector<Expectation> expectations;
  std::vector<BodySummary> bodies;
  /// The point of every dart's vertex: the mesh's numbering, bodies one after another; by dart.
  std::vector<std::uint32_t> dart_point;
};

struct SceneOptions {
  std::vector<std::string> overrides;     ///< "integrator.dt=5e-4", as given to --set
  check::LibraryOptions library = {};
  bool build = true;                      ///< false: check only, leave `state` empty
};

/// Reads, checks and builds a scene. Reports every error it can find, each with line and column
/// (those of overrides in the override's text); null after an error.
[[nodiscard]] std::unique_ptr<Scene> load_scene(const std::filesystem::path& path,
                                                const SceneOptions& options,
                                                support::SourceMap& sources,
                                                support::Diagnostics& diagnostics);

/// docs/scenes.md: the schema table as a page.
[[nodiscard]] std::string schema_documentation();

}  // namespace gmsim::scene
