// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "scene/scene.h"
#include "scene/schema.h"

namespace gmsim::scene {
namespace {

constexpr const char* kIntroduction = R"(# Scenes

A scene is a YAML file that says what is simulated: bodies with their meshes, masses and
interactions, what acts on them, how time advances and what is written. `gmsim scene.yaml` runs
it, `gmsim check scene.yaml` reports every mistake with its line and column. This page is made
from the table that the program itself checks scenes against.

## Values

* **Numbers** are in SI units, or carry one: `dt: 1 ms`, `stiffness: 60 N/m`. The unit must be one
  of the quantity. A bare number for a parameter of an interaction is in the unit that its
  declaration names.
* **Expressions** are those of the rule language. `a` is the dart at hand, a bare embedding `x`
  means `a.x`. Put them in quotes when they hold a comma or `: `. A vector may be written as a
  list of components, each a number or an expression.
* **Truth values** are `true` and `false`; the older spellings `yes`, `no`, `on`, `off` are
  refused.
* A key without a value counts as not given.

## What is evaluated when

1. Meshes are built and placed, masses set, then `prepare` changes the mesh; rules keep the mass
   as they say.
2. `where` of interactions, loads, `fix` and `move`, and the parameters of interactions, are
   evaluated on the bodies as they are then. A parameter that reads `time` is evaluated at every
   stage of a step instead.
3. `initial` changes positions, velocities and other values, one entry after the other.

Interactions act only where the scene says so; what is not named costs nothing.

## Overrides

`--set PATH=VALUE` replaces any value: `--set integrator.dt=5e-4 --set bodies.cloth.mass=0.2`. An
entry of a list is called by its `name`, by its only key, or by its number from 0. The value is
YAML, so quotes and lists work.

## Keys
)";

std::string fallback_text(const SchemaRow& row) {
  if (row.required()) return "needed";
  return row.fallback.empty() ? "" : fmt::format("`{}`", row.fallback);
}

/// What is accepted, "a number above 0 [s], or `auto`".
std::string accepted(const SchemaRow& row) {
  const Allowed allowed = allowed_by(row);
  const std::string words = fmt::format("`{}`", fmt::join(allowed.words, "`, `"));
  if (row.form == Form::Choice) return allowed.words.size() == 1 ? words : "one of " + words;
  std::string text(describe(row.form));
  if (row.form == Form::Integer && !allowed.words.empty()) return text + ": " + words;
  if (allowed.count > 0 && row.form != Form::Named)
    text = fmt::format("{} ({})", text, allowed.count);
  if (allowed.bound)
    text += fmt::format(", {} {}", allowed.strict ? "above" : "at least", *allowed.bound);
  if (!row.unit.empty() && row.unit != "*") text += fmt::format(" [{}]", row.unit);
  return allowed.words.empty() ? text : text + ", or " + words;
}

std::string escaped(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.insert(at, "\\");
  return text;
}

std::string group_of(std::string_view path) {
  return std::string(path.substr(0, path.find_first_of(".[")));
}

}  // namespace

std::string schema_documentation() {
  std::string page = kIntroduction;
  std::string group;
  for (const SchemaRow& row : schema_rows()) {
    if (group_of(row.path) != group) {
      group = group_of(row.path);
      page += fmt::format("\n### `{}`\n\n| key | value | default | meaning |\n|---|---|---|---|\n",
                          group);
    }
    page += fmt::format("| `{}` | {} | {} | {} |\n", row.path, escaped(accepted(row)),
                        escaped(fallback_text(row)), escaped(std::string(row.doc)));
  }
  return page;
}

}  // namespace gmsim::scene
