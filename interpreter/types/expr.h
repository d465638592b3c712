// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "support/span.h"
#include "types/builtin.h"
#include "types/orbit_type.h"
#include "types/unit.h"
#include "types/value.h"
#include "types/value_type.h"

namespace gmsim::types {

/// Number of an embedding (or derived value, interaction parameter, interaction result) in the
/// schema of one dimension of the map.
enum class EmbeddingId : std::uint32_t {};
/// Number of an interaction in the checked library of one dimension.
enum class InteractionId : std::uint32_t {};
/// Position of a local (node, parameter, let, fold variable) in the frame of an item.
enum class Slot : std::uint32_t {};

[[nodiscard]] constexpr std::uint32_t index(EmbeddingId id) { return static_cast<std::uint32_t>(id); }
[[nodiscard]] constexpr std::uint32_t index(InteractionId id) { return static_cast<std::uint32_t>(id); }
[[nodiscard]] constexpr std::uint32_t index(Slot slot) { return static_cast<std::uint32_t>(slot); }

/// The kinds of checked expression. In brackets: what `args` hold and which payload is used.
enum class ExprKind : std::uint8_t {
  Literal,       ///< `value`
  Local,         ///< `slot`: a node or bound dart, a parameter, a let
  Let,           ///< (bound, body) `slot`: body with slot = bound
  // darts
  Alpha,         ///< (dart) `number`: link dimension
  Free,          ///< (dart) `number`: is this link free
  SameDart,      ///< (dart, dart)
  // reading values
  Embedding,     ///< (dart) `embedding`: the value at the dart's orbit
  Has,           ///< (dart) `embedding`: is there one; for an interaction, its presence mark
  Time, Step, Dt,
  Random,        ///< (seed : int, dart) `orbit`: uniform in [0, 1), hash of seed, scene seed, orbit
  // collections: darts, smallest first unless said otherwise
  OrbitDarts,    ///< (dart) `orbit`: all darts of the orbit
  Quotient,      ///< (dart) `orbit` / `orbit2`: one dart of `orbit` for each `orbit2`
  Polygon,       ///< (dart): the darts around the face, in order of the walk @0@1
  AllOrbits,     ///< `orbit`: one dart for each orbit of the map
  Range,         ///< (lo, hi): lo <= i < hi
  Forces,        ///< (dart) `orbit`: atomic forces stored in sub-orbits
  ForceOn,       ///< (dart) `orbit`, `interaction` if `number` is 1: sum of internal atomic forces
  Fold,          ///< (collection, body [, result]) `fold`, `slot`: the variable
  // arithmetic
  Neg, Add, Sub, Mul, Div, Pow,
  Less, LessEqual, Greater, GreaterEqual, Equal, NotEqual,
  And, Or, Not,
  If,            ///< (condition, then, else)
  Tuple,         ///< (x, y [, z]): vec2 or vec3
  Component,     ///< (vec, or eigenpair) `number`: 0..2 for .x .y .z; eigenpair 0 value, 1 vector
  Index,         ///< (array, int)
  Call,          ///< (arguments) `builtin`, `number`: which overload
  Convert,       ///< (int or zero) to `type`
  Grad,          ///< (E, x): derivative of E with respect to the embedding read x
  Frozen,        ///< (e): e, but constant for derivatives
};

enum class FoldKind : std::uint8_t { Sum, Mean, Min, Max, Count, Any, All, ArgMax, ArgMin };

struct Expr;
/// Checked expressions never change, so subtrees are shared freely.
using ExprPtr = std::shared_ptr<const Expr>;

/// A checked expression: names resolved, types and dimension of the map known.
struct Expr {
  ExprKind kind = ExprKind::Literal;
  ValueType type;
  MaybeUnit unit;
  support::Span span;
  std::vector<ExprPtr> args = {};
  Value value = {};
  std::int32_t number = 0;
  Slot slot{};
  EmbeddingId embedding{};
  InteractionId interaction{};
  Builtin builtin{};
  FoldKind fold{};
  OrbitType orbit = {};
  OrbitType orbit2 = {};
};

/// Names for printing: of locals by slot and of embeddings and interactions by number.
struct ExprNames {
  std::vector<std::string> slots;
  std::vector<std::string> embeddings;
  std::vector<std::string> interactions;
};
/// One line in the surface syntax, fully parenthesised where precedence asks for it.
[[nodiscard]] std::string to_string(const Expr& expr, const ExprNames& names);

}  // namespace gmsim::types
