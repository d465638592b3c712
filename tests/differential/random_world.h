// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "check/check.h"
#include "compile/compile.h"
#include "compile/specialise.h"
#include "engine/state.h"
#include "gmap/mesh_builders.h"
#include "random_expression.h"

namespace gmsim::tests {

using support::DiagnosticKind;
using types::DartId;
using types::ValueKind;

/// Rules, a mesh and random values on it.
class RandomWorld {
 public:
  RandomWorld(const gmap::Mesh& mesh, std::uint32_t seed)
      : rules_(check::check_texts({sources_.add("random.rule", tests::expression_rules())},
                                  {.with_stdlib = false}, sources_, diagnostics_)),
        program_(compile::compile_program(rules_.in(mesh.dimension))),
        state_(program_, gmap::build_map(mesh).map),
        random_(seed) {
    REQUIRE_FALSE(diagnostics_.has_errors());
    state_.seed = seed;
    state_.time = 0.75;
    state_.dt = 0.01;
    state_.step = 3;
    for (std::uint32_t i = 0; i < program_.schema.size(); ++i) fill(types::EmbeddingId{i});
    state_.store.use_index(types::OrbitType::cell(2, mesh.dimension));
    sources_of_values_ = compile::stored_sources(program_.schema, state_.store);
    world_ = std::make_unique<compile::World>(compile::World{
        program_.schema, state_.map, state_.store, *program_.schema.find("position")});
  }

  check::CheckedExpression checked(const std::string& text) {
    const auto file = sources_.add("expression", text);
    support::Diagnostics diagnostics;
    auto result = check::check_expression(rules_, program_.dimension, file, {ValueKind::Error},
                                          sources_, diagnostics);
    REQUIRE_MESSAGE(result.value != nullptr, text, ": ",
                    diagnostics.all().empty() ? "" : diagnostics.all()[0].message);
    return result;
  }
  [[nodiscard]] const compile::World& world() const { return *world_; }
  [[nodiscard]] const compile::ValueSources& value_sources() const { return sources_of_values_; }
  [[nodiscard]] const engine::State& state() const { return state_; }
  DartId random_dart() { return static_cast<DartId>(random_() % state_.map.dart_end()); }

 private:
  void fill(types::EmbeddingId id) {
    const gmap::EmbeddingDecl& decl = program_.schema[id];
    if (decl.kind == gmap::EmbeddingKind::Derived || decl.name == "c") return;
    gmap::EmbeddingColumn& column = state_.store.use(id);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (gmap::Row row = 0; row < column.row_end(); ++row) {
      if (decl.optional && random_() % 3 == 0) continue;
      std::vector<double> value(column.stride());
      for (double& x : value) {
        x = uniform(random_);
        if (decl.type.kind == ValueKind::Int) x = std::floor(4 * x);
        if (decl.type.kind == ValueKind::Bool) x = x > 0 ? 1 : 0;
      }
      column.set(row, value);
    }
  }

  support::SourceMap sources_;
  support::Diagnostics diagnostics_;
  check::CheckedRules rules_;
  compile::Program program_;
  engine::State state_;
  std::mt19937 random_;
  compile::ValueSources sources_of_values_;
  std::unique_ptr<compile::World> world_;
};

}  // namespace gmsim::tests
