// SPDX-License-Identifier: MIT
// Rules from text and states from meshes, for tests of the engine.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "compile/program.h"
#include "engine/state.h"
#include "engine/tree_eval.h"
#include "gmap/mesh.h"

namespace gmsim::tests {

/// Rules of one text, checked and compiled for one dimension, with the standard library or alone.
/// Throws std::runtime_error with the rendered messages when they do not check.
class RuleBook {
 public:
  RuleBook(const std::string& text, int dimension, bool with_library = false);
  ~RuleBook();

  [[nodiscard]] const compile::Program& program() const;
  [[nodiscard]] const compile::Rule& rule(std::string_view name) const;
  [[nodiscard]] const compile::Operation& operation(std::string_view name) const;
  [[nodiscard]] types::EmbeddingId embedding(std::string_view name) const;

  /// An expression of the dart `a`.
  struct Expression {
    types::ExprPtr value;
    types::Slot dart{};
    std::uint32_t frame_size = 1;
  };
  [[nodiscard]] Expression expression(const std::string& text) const;
  /// Diagnostics as the user sees them.
  [[nodiscard]] std::string rendered(const support::Diagnostic& diagnostic) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Every data embedding in use: `position` from the mesh, the others filled by fill_random.
[[nodiscard]] std::unique_ptr<engine::State> make_state(const compile::Program& program,
                                                        const gmap::Mesh& mesh,
                                                        std::uint64_t seed = 1);
/// The same on a bare map.
[[nodiscard]] std::unique_ptr<engine::State> make_state(const compile::Program& program,
                                                        gmap::GMap map, std::uint64_t seed = 1);
/// Gives every orbit of every column that is no optional one a random value.
void fill_random(engine::State& state, std::uint64_t seed);

/// Value of an expression at a dart; throws with the message when it has none.
[[nodiscard]] types::Value evaluate(const engine::State& state, const RuleBook::Expression& expr,
                                    types::DartId dart);

/// Everything that a roll-back must restore, as text: links, orbit rows, values.
[[nodiscard]] std::string fingerprint(const engine::State& state);

}  // namespace gmsim::tests
