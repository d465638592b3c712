// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "compile/interaction_body.h"
#include "compile/match_plan.h"
#include "compile/rewrite_plan.h"
#include "gmap/embedding_schema.h"

/// What the engine executes, for one dimension of the map: plain data that can be printed.
namespace gmsim::compile {

struct Parameter {
  std::string name;
  types::ValueType type;
  types::MaybeUnit unit;
  Slot slot{};
  ExprPtr default_value;  ///< null: must be given
  Span span;
};

/// What rules, interactions, criteria and operations have in common.
struct ItemHead {
  std::string name;
  Span name_span;
  bool from_library = false;
  std::uint32_t frame_size = 0;
  std::vector<std::string> slot_names;
  std::vector<Parameter> parameters;

  [[nodiscard]] const Parameter* find_parameter(std::string_view name) const;
};

struct Rule : ItemHead {
  MatchPlan match;
  RewritePlan rewrite;
};

/// Where an interaction or a criterion is found; what it computes is compiled with the scene.
struct RootedPattern : ItemHead {
  OrbitType orbit;            ///< one match per orbit of this type
  MatchPlan match;            ///< one hook: the binder
  ExprPtr first;              ///< null, or the condition that chooses the dart of the orbit
  Slot first_dart{};          ///< the dart that `first` speaks of
  std::optional<EmbeddingId> presence;  ///< only orbits that carry this mark
};

struct Statement;
struct LetStatement {
  Slot slot{};
  ExprPtr value;
};
struct AssignStatement {
  ExprPtr dart;
  EmbeddingId embedding{};
  ExprPtr value;
};
struct ForStatement {
  Slot variable{};
  ExprPtr collection;
  ExprPtr condition;  ///< may be null
  std::vector<Statement> body;
};
struct IfStatement {
  ExprPtr condition;
  std::vector<Statement> then_body;
  std::vector<Statement> else_body;
};
struct ApplyStatement {
  bool operation = false;
  std::uint32_t target = 0;  ///< index into Program::rules or Program::operations
  std::vector<ExprPtr> darts;
  std::vector<std::pair<Slot, ExprPtr>> parameters;
};
struct Statement {
  Span span;
  std::variant<LetStatement, AssignStatement, ForStatement, IfStatement, ApplyStatement> node;
};
struct Operation : ItemHead {
  OrbitType orbit;
  Slot dart{};
  std::vector<Statement> body;
};

struct Program {
  int dimension = 2;
  gmap::EmbeddingSchema schema;
  std::vector<Rule> rules;
  std::vector<Operation> operations;
  std::vector<RootedPattern> interactions;
  std::vector<RootedPattern> criteria;
  std::vector<InteractionBody> interaction_bodies;  ///< parallel to `interactions`
  std::vector<CriterionBody> criterion_bodies;      ///< parallel to `criteria`

  [[nodiscard]] const Rule* find_rule(std::string_view name) const;
  [[nodiscard]] const Operation* find_operation(std::string_view name) const;
};

}  // namespace gmsim::compile
