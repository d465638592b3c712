// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "support/span.h"
#include "types/expr.h"

/// What interactions, criteria and lone expressions compute at a match: plain data that a
/// Specialiser turns into arithmetic. Where they match is a RootedPattern (compile/program.h).
namespace gmsim::compile {

using support::Span;
using types::EmbeddingId;
using types::ExprPtr;
using types::InteractionId;
using types::OrbitType;
using types::Slot;

struct BodyParameter {
  std::string name;
  types::ValueType type;
  types::MaybeUnit unit;
  Slot slot{};
  /// Where a parameter of an interaction is stored; empty for one of a criterion.
  std::optional<EmbeddingId> embedding = std::nullopt;
  ExprPtr default_value = nullptr;  ///< null: must be given
  Span span = {};
};

/// A `let` (slot = value) or a `where` (condition), in the order of the file.
struct BodyStep {
  enum class Kind : std::uint8_t { Let, Where } kind = Kind::Let;
  Slot slot{};
  ExprPtr value;
};

struct BodyResult {
  std::string name;
  types::ValueType type;
  types::MaybeUnit unit;
  std::optional<EmbeddingId> embedding = std::nullopt;  ///< of an interaction's result
  Slot slot{};
  ExprPtr value;
  Span span = {};
};

/// `force a, b on corner = EXPR;` or, with a collection, `force x in polygon(a) on dart = EXPR;`.
struct BodyForce {
  std::vector<ExprPtr> targets;  ///< dart expressions; with a collection: Local(variable)
  ExprPtr collection;            ///< null, or darts
  Slot variable{};
  OrbitType orbit;               ///< where the atomic force lives, inside `vertex`
  ExprPtr value;                 ///< explicit part, may be null
  Span span = {};
};

/// Names, locals and values that all bodies have.
struct ItemBody {
  std::string name;
  Span name_span = {};
  bool from_library = false;
  std::uint32_t frame_size = 0;
  std::vector<std::string> slot_names;

  OrbitType orbit;           ///< one match for each orbit of this type
  Slot dart{};               ///< the binder
  std::uint32_t hook = 0;    ///< the binder's node in `nodes`
  std::vector<Slot> nodes;   ///< of the matched pattern, in the order of MatchPlan::nodes
  std::vector<BodyParameter> parameters;
  std::vector<BodyStep> steps;
  std::vector<BodyResult> results;
};

struct InteractionBody : ItemBody {
  InteractionId id{};
  bool external = false;     ///< a load, which "internal force" criteria leave out
  EmbeddingId presence{};
  ExprPtr energy;            ///< may be null
  std::vector<BodyForce> forces;
};

struct CriterionBody : ItemBody {
  std::optional<InteractionId> interaction;  ///< `of`: shares that interaction's match
  ExprPtr value;
  /// What is done where it fires, unless a scene says otherwise.
  struct Change {
    bool operation = false;
    std::uint32_t target = 0;  ///< index into Program::rules or Program::operations
    std::uint32_t node = 0;    ///< in `nodes`
  };
  std::optional<Change> change;
};

/// An expression about the dart in `dart`, on orbits of one type: an output field, a value of the
/// scene.
[[nodiscard]] ItemBody expression_body(std::string name, OrbitType orbit, Slot dart,
                                       std::uint32_t frame_size);

}  // namespace gmsim::compile
