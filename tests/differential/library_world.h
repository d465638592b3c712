// SPDX-License-Identifier: MIT
// The standard library on a shaken mesh, every interaction present with random parameters.
#pragma once

#include <doctest/doctest.h>

#include <memory>
#include <random>
#include <string>
#include <vector>

#include "check/check.h"
#include "compile/compile.h"
#include "compile/specialise.h"
#include "engine/enumerate.h"
#include "engine/state.h"
#include "gmap/mesh.h"

namespace gmsim::tests {

class LibraryWorld {
 public:
  explicit LibraryWorld(const gmap::Mesh& mesh, std::uint32_t seed, const std::string& rules = {})
      : rules_(checked(rules)),
        program_(compile::compile_program(rules_.in(mesh.dimension))),
        built_(gmap::build_map(mesh)),
        state_(program_, built_.map),
        random_(seed) {
    REQUIRE_MESSAGE(!diagnostics_.has_errors(), diagnostics_.all().front().message);
    state_.use_data();
    for (std::uint32_t i = 0; i < program_.schema.size(); ++i) fill(types::EmbeddingId{i});
    place(mesh);
    sources_of_values_ = compile::stored_sources(program_.schema, state_.store);
    world_ = std::make_unique<compile::World>(compile::World{
        program_.schema, state_.map, state_.store, *program_.schema.find("position")});
  }

  [[nodiscard]] const compile::Program& program() const { return program_; }
  [[nodiscard]] const compile::World& world() const { return *world_; }
  [[nodiscard]] const compile::ValueSources& value_sources() const { return sources_of_values_; }
  [[nodiscard]] compile::ValueSources& value_sources() { return sources_of_values_; }
  [[nodiscard]] engine::State& state() { return state_; }
  [[nodiscard]] std::uint32_t interaction(const std::string& name) const {
    for (std::uint32_t i = 0; i < program_.interactions.size(); ++i)
      if (program_.interactions[i].name == name) return i;
    FAIL("no interaction ", name);
    return 0;
  }
  [[nodiscard]] types::EmbeddingId embedding(const std::string& name) const {
    return program_.schema.find(name).value();
  }
  [[nodiscard]] std::vector<double> value(const std::string& name, types::DartId dart) const {
    const auto found = state_.store.get(embedding(name), dart);
    return {found.begin(), found.end()};
  }

  /// The nodes of each match of an interaction, and its frame with them in place.
  template <typename Visit>
  void each_match(std::uint32_t interaction, const Visit& visit) {
    const compile::RootedPattern& item = program_.interactions[interaction];
    engine::Matcher matcher(state_);
    const engine::Enumeration where{.orbit = item.orbit, .first = item.first.get(),
                                    .first_dart = item.first_dart, .presence = item.presence};
    const auto error = engine::for_each_match(
        matcher, state_, item.match, item.frame_size, {}, where,
        [&](types::DartId, const engine::Match& match, engine::Frame& frame) {
          std::vector<types::DartId> nodes;
          for (compile::Column c = 0; c < item.match.nodes.size(); ++c)
            nodes.push_back(match.dart(0, c));
          visit(nodes, frame);
        });
    REQUIRE_MESSAGE(!error, error->message);
  }

 private:
  check::CheckedRules checked(const std::string& rules) {
    std::vector<support::FileId> texts;
    if (!rules.empty()) texts.push_back(sources_.add("test.rule", rules));
    return check::check_texts(texts, {}, sources_, diagnostics_);
  }
  double uniform(double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(random_);
  }
  void fill(types::EmbeddingId id) {
    const gmap::EmbeddingDecl& decl = program_.schema[id];
    const bool stored = decl.kind != gmap::EmbeddingKind::Derived &&
                        decl.role != gmap::EmbeddingRole::Result;
    if (!stored) return;
    gmap::EmbeddingColumn& column = state_.store.use(id);
    for (gmap::Row row = 0; row < column.row_end(); ++row) {
      std::vector<double> value(column.stride(), 1.0);
      if (decl.role != gmap::EmbeddingRole::Presence && decl.type.kind != types::ValueKind::Bool)
        for (double& x : value) x = decl.name == "velocity" ? uniform(-1, 1) : uniform(0.5, 1.5);
      column.set(row, value);
    }
  }
  void place(const gmap::Mesh& mesh) {
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      if (built_.point_dart[i] == types::kNoDart) continue;
      std::array<double, 3> at = mesh.points[i];
      for (double& x : at) x += uniform(-0.08, 0.08);
      state_.store.set(embedding("position"), built_.point_dart[i], at);
    }
  }

  support::SourceMap sources_;
  support::Diagnostics diagnostics_;
  check::CheckedRules rules_;
  compile::Program program_;
  gmap::MeshMap built_;
  engine::State state_;
  std::mt19937 random_;
  compile::ValueSources sources_of_values_;
  std::unique_ptr<compile::World> world_;
};

}  // namespace gmsim::tests
