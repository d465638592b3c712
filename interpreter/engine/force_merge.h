// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/force_kernel.h"
#include "engine/match_table.h"

namespace gmsim::engine {

/// How matches between the same two vertices become one: their forces are linear in some parameters,
/// which are added up, and the other parameters are equal. Where no parameter has a column that
/// could be added up, equal matches are counted and the force multiplied.
struct MergePlan {
  struct Column {
    InputOrigin origin;   ///< in the matches' own table
    bool summed = false;
  };
  std::array<std::uint32_t, 2> ends{};  ///< roles
  bool symmetric = false;               ///< exchanging the ends exchanges the forces
  bool counted = false;                 ///< a last column holds the number of matches
  std::vector<Column> columns;          ///< values of the merged matches, in this order
  ForceProgram program;                 ///< roles 0 and 1 are the ends, columns are Own
};

/// Decided from the program alone: empty when its matches do not merge.
[[nodiscard]] std::optional<MergePlan> plan_merge(const compile::Shape& shape,
                                                  const ForceProgram& program);

/// The merged form of a table. Each group has the key and the orientation of its first match.
class MergedTable {
 public:
  explicit MergedTable(MergePlan plan);

  /// Groups the matches of a table anew.
  void rebuild(const MatchTable& atomic, const gmap::EmbeddingStore& store);

  // Local changes: a group is dissolved, and its matches, with others, are grouped again.
  /// Row of the group that holds the match with this key; kNoRow when none does.
  [[nodiscard]] std::uint32_t group_of(DartId key) const;
  /// Appends the keys of a group's matches.
  void members(std::uint32_t row, std::vector<DartId>& keys) const;
  /// All its matches are between other vertices now.
  void set_ends(std::uint32_t row, std::array<Row, 2> ends) {
    for (std::uint32_t k = 0; k < 2; ++k) table_.set_row(row, k, ends[k]);
  }
  /// Takes a group out.
  void remove(std::uint32_t row);
  /// Groups these rows of the table of matches; new groups are appended.
  void group(const MatchTable& atomic, const gmap::EmbeddingStore& store,
             std::span<const std::uint32_t> rows);

  /// Where the force of one match stands in its group, all of whose matches push alike
  /// (MergePlan::counted).
  struct Share {
    std::uint32_t force = 0;  ///< of the group
    double share = 1;
  };
  /// Of force number `force` of a match with these ends.
  [[nodiscard]] Share share(std::uint32_t row, std::uint32_t force,
                            const std::array<Row, 2>& ends) const;

  [[nodiscard]] const MatchTable& table() const { return table_; }
  [[nodiscard]] const ForceKernel& kernel() const { return kernel_; }
  [[nodiscard]] const ForceKernel& product();
  [[nodiscard]] const MergePlan& plan() const { return plan_; }

 private:
  /// A match as seen by grouping; numbers in `values_`.
  struct Candidate {
    DartId key;
    std::array<Row, 2> ends;
    std::uint32_t values = 0;  ///< where they begin
  };
  [[nodiscard]] bool together(const Candidate& a, const Candidate& b) const;
  [[nodiscard]] bool before(const Candidate& a, const Candidate& b) const;
  void read_values(const MatchTable& atomic, const gmap::EmbeddingStore& store, std::uint32_t row);
  void add_group(std::span<const Candidate> group);
  void remember(std::span<const Candidate> group, std::uint32_t row);

  MergePlan plan_;
  std::uint32_t value_count_ = 0;
  MatchTable table_;
  ForceKernel kernel_;
  std::unique_ptr<ForceKernel> product_;
  std::vector<double> values_;
  std::vector<double> sums_;
  struct Member {
    DartId head = gmap::kNoDart;  ///< key of the group
    DartId next = gmap::kNoDart;  ///< next match of the group
    std::uint32_t row = 0;        ///< of the group; of heads only
  };
  std::vector<Member> by_key_;
};

}  // namespace gmsim::engine
