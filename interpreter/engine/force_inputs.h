// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compile/specialise.h"
#include "engine/force_context.h"
#include "engine/tree_eval.h"

namespace gmsim::engine {

/// Where an input of a force program comes from, the same for all matches of a shape.
struct InputOrigin {
  enum class Kind : std::uint8_t {
    Position,        ///< of the vertex `role`, m
    Velocity,        ///< m/s
    PositionChange,  ///< direction of a derivative
    VelocityChange,
    Column,          ///< `embedding` at the orbit `role`, from double `offset` on
    Own,             ///< the match's own numbers from `offset` on
    ForceOn,         ///< sum of atomic forces on the orbit `role`, of interaction `offset` - 1 or (0) all, N
    AtomicForce,     ///< the one in column `role` of the match, N
    Time,            ///< s
    Dt,
    Step
  };
  Kind kind = Kind::Own;
  std::uint32_t role = 0;
  std::uint32_t offset = 0;
  std::uint32_t width = 1;  ///< doubles
  EmbeddingId embedding{};
  types::OrbitType orbit = {};  ///< ForceOn: of the role
};

/// The inputs of a shape's graph.
class ShapeInputs {
 public:
  ShapeInputs(const ForceContext& context, const compile::Shape& shape);

  /// By number in graph.inputs().
  [[nodiscard]] const std::vector<InputOrigin>& origins() const { return origins_; }
  /// How many numbers a match of this shape knows itself: random draws, and derived values that do
  /// not change while the integrator runs.
  [[nodiscard]] std::uint32_t own_count() const { return own_count_; }
  /// The same value by value: how many numbers each has.
  [[nodiscard]] std::vector<std::uint32_t> own_widths() const;
  /// The roles of which they are, ascending.
  [[nodiscard]] const std::vector<std::uint32_t>& own_roles() const { return own_roles_; }
  /// The roles of which stored values are read, ascending.
  [[nodiscard]] const std::vector<std::uint32_t>& column_roles() const { return column_roles_; }
  /// Do all of them change only when an orbit of a role holds a changed dart?
  [[nodiscard]] bool own_stay_in_orbits() const;
  /// Appends them for the match with these roles.
  std::optional<support::Diagnostic> read_own(TreeEvaluator& reader,
                                              std::span<const compile::Role> roles,
                                              std::vector<double>& out) const;

 private:
  struct Derived {
    EmbeddingId embedding{};
    std::uint32_t role = 0;
    std::uint32_t offset = 0;
    std::uint32_t width = 0;
  };
  InputOrigin origin(const compile::Shape& shape, const compile::ir::Input& input,
                     std::uint32_t width);
  InputOrigin embedding_origin(const compile::ir::Input& input, std::uint32_t width);
  std::uint32_t derived_at(EmbeddingId embedding, std::uint32_t role);

  const ForceContext& context_;
  std::vector<compile::Draw> draws_;   // own numbers 0 .. draws-1
  std::vector<Derived> derived_;       // and what follows
  std::vector<InputOrigin> origins_;
  std::uint32_t own_count_ = 0;
  std::vector<std::uint32_t> own_roles_, column_roles_;
};

}  // namespace gmsim::engine
