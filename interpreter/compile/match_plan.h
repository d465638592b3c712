// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "support/span.h"
#include "types/expr.h"
#include "types/orbit_type.h"

/// How a pattern is matched: plain data made by compile_match, executed by engine::Matcher.
namespace gmsim::compile {

using support::Span;
using types::EmbeddingId;
using types::ExprPtr;
using types::OrbitType;
using types::Slot;

/// A node of a pattern is a column of the row table, a dart of the abstract orbit a row
/// (docs/theory.md, matching).
using Column = std::uint32_t;
inline constexpr std::int8_t kNoEntry = -1;  ///< `_` in a label

struct PlanNode {
  std::string name;
  std::vector<std::int8_t> label;  ///< all nodes of a plan have labels of one length
  Slot slot{};                     ///< where expressions find the dart of row 0
  Span span;
};
/// The links of the pattern as written: what the naive matcher follows and messages name.
struct PlanArc {
  std::vector<std::int8_t> dimensions;  ///< one: a link; several: a path over unnamed darts
  Column from = 0;
  Column to = 0;
  Span span;
};

/// One action on a row whose hook darts are known.
struct LinkStep {
  enum class Kind : std::uint8_t {
    Follow,       ///< dart(to) := alpha_dimension(dart(from))
    RequireLink,  ///< alpha_dimension(dart(from)) == dart(to)
    RequireFree,  ///< alpha_dimension(dart(from)) == dart(from)
    FollowPath,   ///< dart(to) := the end of the walk from dart(from) along `path`
    RequirePath   ///< the walk from dart(from) along `path` ends at dart(to)
  };
  Kind kind = Kind::Follow;
  std::int8_t dimension = 0;
  Column from = 0;
  Column to = 0;
  std::vector<std::int8_t> path = {};
  std::uint32_t arc = 0;  ///< which arc of the pattern this realises, for messages
};
/// alpha_dimension(dart(column, row)) == dart(column, next[row][position]) in every row. Steps
/// that follow from others by the cycle condition of maps are left out.
struct LabelStep {
  Column column = 0;
  std::uint32_t position = 0;
  std::int8_t dimension = 0;
};
/// An expression of row 0.
struct Predicate {
  enum class Kind : std::uint8_t {
    Parameter,  ///< slot = value unless the caller gave the parameter
    Let,        ///< slot = value
    Where       ///< the match fails unless value is true
  };
  static constexpr std::uint32_t kWholeMatch = 0xffffffffu;
  Kind kind = Kind::Where;
  Slot slot{};
  ExprPtr value;
  std::uint32_t after = kWholeMatch;  ///< evaluated before link step number `after`, or at the end
};

/// Rooted matching of one pattern: the hooks are given, everything else follows, so there is at
/// most one match (Jerboa's row table).
struct MatchPlan {
  std::vector<PlanNode> nodes;
  std::vector<PlanArc> arcs;
  std::vector<Column> hooks;  ///< in the order in which the caller gives their darts
  std::uint32_t positions = 0;           ///< length of the labels
  std::uint32_t width = 0;               ///< columns of the table: the nodes and what a rule adds
  std::vector<LinkStep> links;           ///< in the order of execution
  std::vector<LabelStep> labels;         ///< checks after all rows are there
  std::vector<Predicate> predicates;     ///< ascending `after`

  /// The dimensions of the first hook's label: the orbit of which one match stands for all.
  [[nodiscard]] OrbitType hook_orbit() const;
};

}  // namespace gmsim::compile
