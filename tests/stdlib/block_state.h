// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "check/check.h"
#include "compile/program.h"
#include "engine/state.h"
#include "engine/tree_eval.h"
#include "gmap/mesh.h"
#include "stdlib/test_block.h"

namespace gmsim::test {

/// What a block runs on: the library with the block's own rules, compiled for the mesh's
/// dimension, and the state made from the mesh. Problems are collected as sentences.
class BlockState {
 public:
  using DartId = types::DartId;

  /// Throws std::runtime_error when the rules do not check or the mesh does not build.
  explicit BlockState(const TestBlock& block);

  [[nodiscard]] engine::State& state() { return *state_; }
  [[nodiscard]] const compile::Program& program() const { return program_; }
  [[nodiscard]] const check::RuleLibrary& library() const {
    return rules_->in(program_.dimension);
  }
  [[nodiscard]] DartId point_dart(std::size_t point) const { return mesh_map_.point_dart.at(point); }

  /// Checks an expression; throws std::runtime_error with the diagnostics.
  [[nodiscard]] check::CheckedExpression expression(const std::string& text,
                                                    const types::ValueType& wanted = {});
  /// Its value at a dart, as doubles.
  [[nodiscard]] std::vector<double> value(const check::CheckedExpression& expression, DartId dart);
  [[nodiscard]] std::vector<double> value(const std::string& text, DartId dart,
                                          const types::ValueType& wanted = {});
  [[nodiscard]] bool holds(const check::CheckedExpression& condition, DartId dart);
  /// The orbit called `text`, or literal as in `<0,1>`.
  [[nodiscard]] types::OrbitType orbit(const std::string& text);
  /// Evaluates at every orbit of an embedding, then stores.
  void set(const std::string& embedding, const std::string& text);
  /// What is wrong with the map or the values of embeddings; empty when nothing is.
  [[nodiscard]] std::string invalid() const;

 private:
  [[nodiscard]] std::string rendered() const;
  void check_rules(const TestBlock& block);
  void build(const TestBlock& block);

  support::SourceMap sources_;
  support::Diagnostics diagnostics_;
  std::shared_ptr<const check::CheckedRules> rules_;
  compile::Program program_;
  gmap::MeshMap mesh_map_;
  std::unique_ptr<engine::State> state_;
};

}  // namespace gmsim::test
