// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compile/match_plan.h"

/// What a rule changes at a match: plain data made by compile_rewrite, executed by engine::Rewriter.
namespace gmsim::compile {

/// A link that the rule makes, in every row. Links that are equal on both sides are not written.
struct LinkWrite {
  static constexpr std::int32_t kExplicit = -1;
  std::int8_t dimension = 0;
  Column from = 0;
  Column to = 0;
  /// Explicit: alpha_dimension links dart(from, row) and dart(to, row) both ways. Else a label
  /// entry: alpha_dimension(dart(from, row)) := dart(from, next[row][position]).
  std::int32_t position = kExplicit;
};

enum class NodeFate : std::uint8_t { Preserved, Created, Removed };

/// A column whose darts the rule touches.
struct ColumnChange {
  Column column = 0;
  NodeFate fate = NodeFate::Preserved;
  OrbitType links;  ///< dimensions in which its links change; all of them unless preserved
};

/// node.embedding = value: the value is computed on the map before the rewrite, once for every
/// group of rows that the rule itself puts into one orbit, and stored in the orbit after it.
struct Assignment {
  Column column = 0;
  EmbeddingId embedding{};
  ExprPtr value;
  /// Label positions that stay inside the orbit: rows joined by them are one orbit.
  std::vector<std::uint32_t> joined = {};
  Span target_span;
  Span span;

  /// `joined`, a bit for each position.
  [[nodiscard]] std::uint8_t joined_rows() const {
    unsigned bits = 0;
    for (const std::uint32_t position : joined) bits |= 1u << position;
    return static_cast<std::uint8_t>(bits);
  }
};

/// What becomes of the orbits of one type that meet one class of nodes: those that links of the
/// type join within a row of the right side. Label positions in `joined` join rows.
struct OrbitClass {
  enum class Fate : std::uint8_t {
    Kept,   ///< no orbit is cut or joined; created darts enter the orbits of a preserved node
    Whole,  ///< the orbits are in the match: the class in one group of joined rows is one orbit
    Open    ///< the orbits of the touched darts may be any, and go beyond the match
  };
  Fate fate = Fate::Open;
  std::vector<Column> columns;  ///< Kept: created; Whole: all of the class; Open: touched
  Column kept = 0;              ///< Kept: the preserved node
  std::vector<std::uint32_t> joined = {};
};

/// The classes of one orbit type of which the rule touches a dart.
struct OrbitClasses {
  OrbitType type;
  std::vector<OrbitClass> classes;
};

struct RewritePlan {
  std::uint32_t kept_columns = 0;     ///< columns of the left side; created ones follow
  std::uint32_t created_columns = 0;
  std::vector<std::string> created_names;
  std::vector<LinkWrite> writes;
  std::vector<ColumnChange> changes;  ///< ascending column; empty: the rule changes values only
  std::vector<Assignment> assignments;
  OrbitType changed_links;            ///< union over all changes
  OrbitType made_links;               ///< dimensions of links made between different darts
  /// Embeddings of which the rule creates orbits that no assignment gives a value.
  std::vector<EmbeddingId> unassigned;
  std::vector<OrbitClasses> orbits;   ///< one entry for each orbit type of the schema

  [[nodiscard]] bool creates() const { return created_columns > 0; }
  [[nodiscard]] bool removes() const;
  /// Can an orbit of this type be made, cut, joined or removed?
  [[nodiscard]] bool affects(OrbitType type) const;
  /// Null when no embedding lives on such orbits.
  [[nodiscard]] const OrbitClasses* find_orbits(OrbitType type) const;
};

}  // namespace gmsim::compile
