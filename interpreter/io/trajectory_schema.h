// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh_frame.h"
#include "support/field_name.h"

namespace gmsim::io {

/// Name of the format in the file, and its version.
inline constexpr std::string_view kTrajectoryFormat = "gmsim-trajectory";
inline constexpr int kTrajectoryVersion = 2;

/// What a field has one row for.
enum class FieldPlace {
  Point,  ///< every vertex of the mesh
  Cell,   ///< every cell of the mesh
  Frame,  ///< the frame itself: one number
  Orbit   ///< orbits of another type, named by a dart each
};

struct FieldDescription {
  std::string name;  ///< see is_field_name
  std::uint32_t components = 1;
  FieldPlace place = FieldPlace::Point;
  NumberType type = NumberType::Float32;
  std::string expression;  ///< what the scene asked for
  std::string orbit;       ///< "<1,2>"
  std::string unit;        ///< "m/s"; empty: none known
};

/// A column of the time series that has its own clock.
struct SeriesDescription {
  std::string name;
  std::uint32_t components = 1;
  NumberType type = NumberType::Float64;  ///< Float64 or Int64
  std::string unit;
};

struct RuleSource {
  std::string module;  ///< "springs.stretch"
  std::string path;    ///< where it was read
  std::string text;
};

/// Everything a trajectory says about its run, fixed before the first frame.
struct RunDescription {
  int dimension = 2;  ///< of the map
  std::string scene;  ///< the YAML as it was run
  std::vector<RuleSource> rules;
  std::vector<std::string> rule_names, criterion_names;  ///< numbers in events are positions here
  std::string program_version, commit, command;
  std::string started;  ///< ISO 8601
  std::uint64_t seed = 0;
  std::vector<FieldDescription> fields;
  std::vector<SeriesDescription> series;
  /// Whether volumes without a VTK type may appear; the tables for them are made only then.
  bool polyhedra = false;
  /// Links of every dart at the first frame, dimension + 1 a row; -1: the dart does not exist.
  /// Empty: not recorded.
  std::vector<std::int32_t> alpha;
  std::size_t expected_points = 0, expected_cells = 0;  ///< per frame; for the size of chunks
};

/// One tear: a rule applied because a criterion held.
struct TearEvent {
  std::int64_t step = 0;
  double time = 0;  ///< s
  std::int32_t rule = -1, criterion = -1;
  double value = 0, threshold = 0;
  std::int32_t dart = -1;
  std::array<double, 3> position = {};  ///< m
  std::int32_t new_vertices = 0;
  std::vector<std::int32_t> cells;  ///< a dart of each cell that was involved
};

using support::field_name;
using support::is_field_name;
/// What is wrong with a description, in words; empty when it is sound.
[[nodiscard]] std::optional<std::string> find_problem(const RunDescription& run);

}  // namespace gmsim::io
