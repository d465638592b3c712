// SPDX-License-Identifier: MIT
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "scene/override.h"
#include "scene/resolved_text.h"
#include "scene/validate.h"
#include "scene/yaml_tree.h"

namespace gmsim::test {

/// Place, kind and message of each diagnostic, in a line.
inline std::string brief(const support::Diagnostics& diagnostics,
                         const support::SourceMap& sources) {
  std::ostringstream lines;
  for (const support::Diagnostic& diagnostic : diagnostics.all()) {
    if (diagnostic.place) {
      const auto at = sources.locate(diagnostic.place->file, diagnostic.place->begin);
      lines << at.line << ':' << at.column << ' ';
    }
    lines << support::name_of(diagnostic.kind) << ": " << diagnostic.message << '\n';
  }
  return lines.str();
}

/// A scene that was read and compared with the schema, from a text.
struct SceneText {
  support::SourceMap sources;
  support::Diagnostics diagnostics;
  scene::YamlNode tree;

  explicit SceneText(const std::string& text, const std::vector<std::string>& overrides = {}) {
    const auto file = sources.add("scene.yaml", text);
    tree =
        scene::parse_yaml(sources, {file, 0, static_cast<std::uint32_t>(text.size())}, diagnostics);
    if (diagnostics.has_errors()) return;
    scene::apply_overrides(tree, overrides, sources, diagnostics);
    if (!diagnostics.has_errors()) scene::validate_scene(tree, sources, diagnostics);
  }

  /// "3:9 unknown-key: there is no key `x` here", one line each.
  [[nodiscard]] std::string errors() const { return brief(diagnostics, sources); }
  [[nodiscard]] std::string rendered() const {
    std::ostringstream out;
    support::render(diagnostics, sources, out);
    return out.str();
  }
};

/// The cloth of the language's first scene, complete.
inline const std::string kCloth = R"yaml(dimension: 2
rules: [springs, criteria, tear]
bodies:
  - name: cloth
    mesh: { grid: { patches: [10, 10], size: [1.0, 1.0], cells: quads } }
    place: { scale: 1, rotate: { axis: [0, 0, 1], degrees: 0 }, translate: [0, 0, 0] }
    mass: 0.1
    prepare: [ { apply: split_quad, to: face, where: "random(7, face(a)) < 0.5" } ]
    interactions:
      stretch_spring:        { stiffness: 60, damping: 0.1, where: "true" }
      linear_shear_spring:   { stiffness: 43, damping: 0.1 }
      linear_bending_spring: { stiffness: 10, damping: 0.1 }
    initial: [ { where: "true", position: "1.5 * position", velocity: "(0, 0, 0)" } ]
gravity: [0, 0, -9.81]
loads: [ { vertex_drag: { coefficient: 0.0 } } ]
fix:  [ { body: cloth, where: "position.y > 0.999 and (position.x < 0.001 or position.x > 0.999)", on_split: both } ]
move: [ { where: "position.y < 0.001", velocity: ["0", "-0.1", "0"] } ]
integrator: { method: rk4, dt: 1e-3, on_unstable: error }
duration: 2.0
seed: 1
output: { file: fig14.vtkhdf, every: 0.02, fields: [velocity, mass, { name: fall, value: "norm(velocity)" }] }
expect: [ { value: "max(x in all vertex : -x.position.z)", at: end, equals: 0.5, within: 1e-6 } ]
)yaml";

/// The same text with one piece exchanged.
inline std::string exchanged(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  return at == std::string::npos ? "?" : text.replace(at, from.size(), to);
}

}  // namespace gmsim::test
