// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "gmap/embedding_schema.h"
#include "support/span.h"
#include "types/expr.h"

/// Items after checking, for one dimension of the map: names resolved, labels and links are
/// numbers, functions and patterns expanded. Nothing here refers to the source text but spans.
namespace gmsim::check {

using support::Span;
using types::EmbeddingId;
using types::ExprPtr;
using types::InteractionId;
using types::OrbitType;
using types::Slot;

// ---- patterns -----------------------------------------------------------------------------------

using NodeIndex = std::uint32_t;
/// An entry of a label word: a link dimension, or kBlank for `_`.
using LabelEntry = std::int8_t;
inline constexpr LabelEntry kBlank = -1;

/// A node of a pattern: one copy of the abstract orbit (theory 1.4). An empty label is one dart.
struct PatternNode {
  std::string name;
  std::vector<LabelEntry> label;
  Slot slot{};      ///< where expressions find the dart (left nodes; unused for created nodes)
  Span span;        ///< first mention of the name on this side
  Span label_span;  ///< the label, or the name when it has none
};
/// a -dimension- b; a == b is a loop: the node is free in that dimension.
struct PatternArc {
  int dimension = 0;
  NodeIndex a = 0;
  NodeIndex b = 0;
  Span span;
};
/// from -0.1- to: `to` is reached over unnamed darts, which are only walked.
struct PatternPath {
  std::vector<int> dimensions;
  NodeIndex from = 0;
  NodeIndex to = 0;
  Span span;
};
struct Pattern {
  std::vector<PatternNode> nodes;
  std::vector<PatternArc> arcs;
  std::vector<PatternPath> paths;
  Span span;
  [[nodiscard]] std::optional<NodeIndex> find(const std::string& name) const;
};

// ---- what items have in common ------------------------------------------------------------------

struct Parameter {
  std::string name;
  types::ValueType type;
  types::MaybeUnit unit;
  Slot slot{};
  ExprPtr default_value;  ///< null: must be given
  /// Of an interaction's parameter: where it is stored.
  std::optional<EmbeddingId> embedding = std::nullopt;
  Span span;
  double unit_scale = 1.0;  ///< SI units per declared unit: a bare number given for it is in that
};
/// A `let` (slot = value) or a `where` (condition), in the order of the file.
struct Step {
  enum class Kind { Let, Where } kind = Kind::Let;
  Slot slot{};
  ExprPtr value;
};
/// What an item reads and writes; made by check_effects.
struct Footprint {
  std::vector<EmbeddingId> reads;
  std::vector<EmbeddingId> writes;
  OrbitType reads_links;   ///< dimensions followed by patterns and walks
  OrbitType writes_links;  ///< dimensions of links that a rule makes or cuts
  bool creates_darts = false;
  bool removes_darts = false;
  bool reads_forces = false;
  bool reads_time = false;
};
struct ItemHead {
  std::string name;
  std::string doc;
  Span name_span;
  Span span;
  int dimension = 2;
  bool from_library = false;            ///< read from stdlib-rules
  std::uint32_t frame_size = 0;         ///< slots its expressions use
  std::vector<std::string> slot_names;  ///< by slot, for messages and dumps
  Footprint footprint;
};

// ---- rules --------------------------------------------------------------------------------------

/// node.embedding = value, evaluated on the map before the rewrite (theory 2.2).
struct Assignment {
  NodeIndex node = 0;  ///< in `right`
  EmbeddingId embedding{};
  ExprPtr value;
  Span target_span;
  Span span;
};
struct Rule : ItemHead {
  Pattern left;
  Pattern right;          ///< equal to left when `has_right` is false
  bool has_right = true;  ///< false: changes values only
  std::vector<NodeIndex> hooks;  ///< left nodes, in the order of the rule's parameters
  /// For each right node the left node of the same name, empty for a created one; and back.
  std::vector<std::optional<NodeIndex>> right_to_left;
  std::vector<std::optional<NodeIndex>> left_to_right;
  std::vector<Parameter> parameters;
  std::vector<Step> steps;
  std::vector<Assignment> assignments;
};

// ---- interactions, criteria, families -----------------------------------------------------------

/// `force a, b on corner = EXPR;` or, with `variable`, `force x in polygon(a) on dart = EXPR;`.
struct ForceLine {
  std::vector<ExprPtr> targets;   ///< dart expressions; with a collection: Local(variable)
  ExprPtr collection;             ///< null, or Darts
  Slot variable{};
  OrbitType orbit;                ///< where the atomic force lives, inside `vertex`
  ExprPtr value;                  ///< explicit part, may be null
  Span span;
};
struct Result {
  std::string name;
  types::ValueType type;
  types::MaybeUnit unit;
  std::optional<EmbeddingId> embedding = std::nullopt;  ///< of an interaction's result
  Slot slot{};
  ExprPtr value;
  Span span;
};
struct Interaction : ItemHead {
  InteractionId id{};
  bool external = false;
  OrbitType orbit;
  Slot dart{};                 ///< the binder
  Pattern match;               ///< holds at least the binder's node
  NodeIndex hook = 0;          ///< the binder in `match`
  ExprPtr first;               ///< null, or the condition of `first d where …`
  Slot first_dart{};
  EmbeddingId presence{};
  std::vector<Parameter> parameters;
  std::vector<Step> steps;
  ExprPtr energy;              ///< may be null
  std::vector<ForceLine> forces;
  std::vector<Result> results;
};
/// What is done where a criterion fires, unless a scene says otherwise.
struct DefaultChange {
  bool operation = false;
  std::uint32_t target = 0;  ///< index into RuleLibrary::rules or ::operations
  NodeIndex node = 0;        ///< of the criterion's pattern: the hook of the change
};
struct Criterion : ItemHead {
  std::optional<InteractionId> interaction;  ///< `of`: shares that interaction's match and names
  OrbitType orbit;
  Slot dart{};
  Pattern match;
  NodeIndex hook = 0;
  std::vector<Parameter> parameters;         ///< `threshold` first
  std::vector<Step> steps;
  ExprPtr value;
  std::vector<Result> results;
  std::optional<DefaultChange> change;
};
struct Family {
  std::string name;
  std::string doc;
  Span name_span;
  std::vector<InteractionId> members;
};

// ---- operations ---------------------------------------------------------------------------------

struct OperationStatement;
struct OpLet {
  Slot slot{};
  ExprPtr value;
};
struct OpAssign {
  ExprPtr dart;
  EmbeddingId embedding{};
  ExprPtr value;
};
struct OpFor {
  Slot variable{};
  ExprPtr collection;
  ExprPtr condition;  ///< may be null
  std::vector<OperationStatement> body;
};
struct OpIf {
  ExprPtr condition;
  std::vector<OperationStatement> then_body;
  std::vector<OperationStatement> else_body;
};
struct OpApply {
  bool operation = false;   ///< applies an operation instead of a rule
  std::uint32_t target = 0; ///< index into RuleLibrary::rules or ::operations
  std::vector<ExprPtr> darts;
  std::vector<std::pair<Slot, ExprPtr>> parameters;  ///< slot in the target's frame
};
struct OperationStatement {
  Span span;
  std::variant<OpLet, OpAssign, OpFor, OpIf, OpApply> node;
};
struct Operation : ItemHead {
  OrbitType orbit;
  Slot dart{};
  std::vector<Parameter> parameters;
  std::vector<OperationStatement> body;
};

// ---- the library --------------------------------------------------------------------------------

struct OrbitName {
  std::string name;
  OrbitType orbit;
  std::string doc;
};
/// For `gmsim list functions` and `patterns`; their bodies are expanded where they are used.
struct NamedDoc {
  std::string name;
  std::string signature;
  std::string doc;
  Span span;
};

/// Everything known for one dimension of the map.
struct RuleLibrary {
  int dimension = 2;
  std::vector<OrbitName> orbits;
  gmap::EmbeddingSchema schema;
  std::vector<Rule> rules;
  std::vector<Interaction> interactions;
  std::vector<Family> families;
  std::vector<Criterion> criteria;
  std::vector<Operation> operations;
  std::vector<NamedDoc> functions;
  std::vector<NamedDoc> patterns;

  [[nodiscard]] const Rule* find_rule(std::string_view name) const;
  [[nodiscard]] const Operation* find_operation(std::string_view name) const;
  [[nodiscard]] const Interaction* find_interaction(std::string_view name) const;
  [[nodiscard]] const Criterion* find_criterion(std::string_view name) const;
  [[nodiscard]] const Family* find_family(std::string_view name) const;
  [[nodiscard]] std::optional<OrbitType> find_orbit(std::string_view name) const;
};

}  // namespace gmsim::check
