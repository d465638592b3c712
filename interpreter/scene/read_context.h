// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "check/check.h"
#include "compile/program.h"
#include "scene/import_mesh.h"
#include "scene/plan.h"
#include "scene/validate.h"
#include "scene/yaml_tree.h"
#include "support/diagnostic.h"
#include "support/source_map.h"

namespace gmsim::scene {

/// What an expression may read besides values: forces are known while a scene runs, derivatives
/// only where expressions become part of a criterion's kernel.
enum class MayRead : std::uint8_t { Values, Forces, Derivatives };

/// What reading a validated scene needs: the checked rules, and where messages go.
class ReadContext {
 public:
  ReadContext(const check::CheckedRules& checked, const compile::Program& compiled,
              std::filesystem::path scene_folder, support::SourceMap& source_map,
              support::Diagnostics& report_to)
      : rules(checked),
        program(compiled),
        folder(std::move(scene_folder)),
        sources(source_map),
        diagnostics(report_to) {}

  const check::CheckedRules& rules;
  const compile::Program& program;
  std::filesystem::path folder;  ///< of the scene: files are named relative to it
  support::SourceMap& sources;
  support::Diagnostics& diagnostics;
  std::vector<std::string> body_names = {};

  [[nodiscard]] int dimension() const { return program.dimension; }
  [[nodiscard]] const check::RuleLibrary& library() const { return rules.in(dimension()); }

  void report(support::DiagnosticKind kind, support::Span place, std::string message,
              std::string help = {});

  /// Checks an expression; what is wrong is reported where it stands in the scene.
  [[nodiscard]] SceneExpression expression(const YamlNode& node, const check::WantedValue& wanted,
                                           MayRead may_read = MayRead::Values);
  /// A `where` (always there in a validated scene).
  [[nodiscard]] SceneExpression where(const YamlNode& section, MayRead may_read = MayRead::Values);
  /// Its value where that is the same everywhere and always, else an error.
  [[nodiscard]] std::optional<types::Value> constant(const SceneExpression& expression,
                                                     const std::string& what);
  [[nodiscard]] double number(const YamlNode& node) { return number_of(node, sources); }
  [[nodiscard]] std::int64_t integer(const YamlNode& node) {
    return static_cast<std::int64_t>(number(node));
  }

  /// Reports what an expression reads and may not. True: nothing.
  bool may_read(const types::Expr& expr, MayRead allowed);

  /// The body that a section names; empty when it names none or (reported) an unknown one.
  [[nodiscard]] std::optional<std::size_t> body(const YamlNode& section);
  /// An orbit by name, or as in `<0,2>`.
  [[nodiscard]] std::optional<types::OrbitType> orbit(const YamlNode& node);
  /// "no rule named …" with a suggestion, or why it is absent in this dimension.
  void report_unknown_item(const YamlNode& node, const std::string& kind,
                           const std::vector<std::string>& names);
  void report_unknown_item(const std::string& name, support::Span span, const std::string& kind,
                           const std::vector<std::string>& names);
};

// The parts of a scene, each in a file of its own. All report and leave out what is wrong.
void read_bodies(const YamlNode& scene, ReadContext& context, ScenePlan& plan);
[[nodiscard]] std::optional<ImportedMesh> read_mesh(const YamlNode& body, ReadContext& context);
void read_interactions(const YamlNode& scene, ReadContext& context, ScenePlan& plan);
[[nodiscard]] std::vector<Preparation> read_preparations(const YamlNode& body,
                                                         ReadContext& context);
void read_selections(const YamlNode& scene, ReadContext& context, ScenePlan& plan);

/// What the names of several items have in common.
template <typename Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

}  // namespace gmsim::scene
