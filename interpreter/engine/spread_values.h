// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compile/program.h"
#include "engine/effects.h"
#include "engine/state.h"
#include "engine/tree_eval.h"
#include "gmap/journal.h"
#include "support/diagnostic.h"

namespace gmsim::engine {

/// A value that a rule gives to the orbit of a dart.
struct AssignedValue {
  const compile::Assignment* assignment = nullptr;
  DartId dart = types::kNoDart;
  std::size_t begin = 0;  ///< slice of the numbers of all assigned values
};

/// The orbits of one type that a rewrite changed: what repairs of their index did since `before`.
struct ChangedOrbits {
  /// How much earlier rewrites had done.
  struct Before {
    std::size_t orbits = 0, sources = 0, removed = 0;
    std::uint32_t created = 0, split = 0, merged = 0;
    std::uint64_t visited_darts = 0;
  };
  ChangedOrbits(const gmap::OrbitIndex& changed, const gmap::OrbitRepair& done)
      : index(&changed), repair(&done),
        before{done.orbits.size(), done.sources.size(), done.removed.size(), done.created,
               done.split, done.merged, done.visited_darts} {}

  [[nodiscard]] std::span<const gmap::OrbitChange> orbits() const {
    return std::span(repair->orbits).subspan(before.orbits);
  }
  [[nodiscard]] std::span<const Row> removed() const {
    return std::span(repair->removed).subspan(before.removed);
  }
  /// Takes back what `done`, which is the repair that this is of, says of the rewrite.
  void forget(gmap::OrbitRepair& done) const;

  const gmap::OrbitIndex* index;
  const gmap::OrbitRepair* repair;
  Before before;
};

/// The embedding pass (docs/theory.md, values after a rewrite). Each changed orbit gets, in this
/// order: the value of an assignment; the value that all orbits it came from agree on; what the
/// kind of the embedding says: for an intensive one the merge policy, for an extensive one the sum
/// of its shares; the default; else there is no value, which is an error unless it is optional.
///
/// Shares of an extensive value: its orbit's value divided over all parts of that orbit at once,
/// equally or by `split EXPR`, which is evaluated on the new map when all intensive values are
/// there. A part with an assignment counts as a part, and then takes what is assigned.
class ValueSpreader {
 public:
  ValueSpreader(State& state, TreeEvaluator& evaluator) : state_(state), evaluator_(evaluator) {}

  /// Can storing the values of this rule fail, with the columns that are in use?
  [[nodiscard]] bool may_fail(const compile::Rule& rule);

  /// Stores values after the orbit indices were repaired. Returns an error, after which the caller
  /// rolls back. `numbers` are the components of the assigned values.
  std::optional<support::Diagnostic> run(std::span<const ChangedOrbits> changed,
                                         std::span<const AssignedValue> assigned,
                                         std::span<const double> numbers,
                                         const compile::ItemHead& rule, gmap::Journal* journal,
                                         Effects& effects);

 private:
  struct Column {
    EmbeddingId id{};
    gmap::EmbeddingColumn* values = nullptr;
    const gmap::OrbitIndex* index = nullptr;
  };
  static constexpr std::size_t kFewAssigned = 8;  // to be compared, not stamped
  struct Stamp {
    std::uint32_t epoch = 0;
    std::uint32_t number = 0;
  };
  struct Pending {
    Row row = 0;
    std::size_t begin = 0;  ///< in `computed_`
  };

  void list_columns();
  [[nodiscard]] bool may_fail(const compile::Rule& rule, const Column& column) const;
  void next_epoch(Row row_end);
  void spread(const Column& column, const ChangedOrbits* changed);
  const ChangedOrbits* find(const Column& column, std::span<const ChangedOrbits> changed) const;
  void list_assigned(const Column& column);
  void stamp_assigned(const Column& column);
  void store_assigned(const Column& column);
  void check_agreement(std::uint32_t earlier, std::uint32_t later, std::uint32_t stride);
  [[nodiscard]] bool is_assigned(Row row) const;
  void spread_intensive(const Column& column, const ChangedOrbits& changed);
  void merge(const Column& column, const gmap::OrbitChange& orbit, std::span<const Row> sources);
  bool merge_by_policy(const Column& column, std::span<double> out);
  void spread_extensive(const Column& column, const ChangedOrbits& changed);
  void weigh_parts(const Column& column, const ChangedOrbits& changed);
  [[nodiscard]] double weight(const Column& column, DartId smallest);
  bool add_share(const Column& column, Row source, double weight, std::span<double> out);
  void store_computed(const Column& column);
  void give_default(const Column& column, const gmap::OrbitChange& orbit);
  void clear_removed(const Column& column, const ChangedOrbits& changed);
  void write(const Column& column, Row row, std::span<const double> value);
  void fail(support::Diagnostic diagnostic);

  State& state_;
  TreeEvaluator& evaluator_;
  std::vector<Column> columns_;  // in use, intensive before extensive
  std::size_t listed_ = 0;
  const compile::Rule* judged_rule_ = nullptr;  // by may_fail, with the columns as listed
  bool judged_ = false;

  // of one run
  std::span<const AssignedValue> assigned_;
  std::span<const double> numbers_;
  const compile::ItemHead* rule_ = nullptr;
  gmap::Journal* journal_ = nullptr;
  Effects* effects_ = nullptr;
  std::optional<support::Diagnostic> error_;

  // work space
  std::vector<Stamp> assigned_rows_;  // by row: which assigned value
  std::uint32_t epoch_ = 0;
  std::vector<std::uint32_t> own_;    // assigned values of the column at hand
  std::vector<Row> own_rows_;         // where they go
  std::vector<Pending> pending_;
  std::vector<double> computed_;
  std::vector<Row> valued_;
  std::vector<double> weights_;       // of the changed orbits
  std::vector<Stamp> source_rows_;    // by row: which entry of the totals
  std::vector<double> totals_;        // weight of all parts of a source
  std::vector<std::uint32_t> parts_;  // number of parts of a source
  Frame frame_;
};

}  // namespace gmsim::engine
