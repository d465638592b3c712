// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/force_matches.h"

namespace gmsim::engine {

/// All matches of one shape, column by column: what kernels read. The order of rows does not matter:
/// the place of a match among the sums is its key. The row of a match that is taken out stays,
/// vacant, until the table is packed, so that no other match moves.
class MatchTable {
 public:
  struct Widths {
    std::uint32_t roles = 0;  ///< and behind them the atomic forces that a match goes through
    std::uint32_t nodes = 0, targets = 0;
    std::vector<std::uint32_t> own;  ///< doubles of each value that matches know themselves
  };
  explicit MatchTable(Widths widths);

  /// Rows, vacant ones included.
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(keys_.size()); }
  /// Matches.
  [[nodiscard]] std::uint32_t count() const { return size() - vacant_; }
  [[nodiscard]] bool vacant(std::uint32_t row) const { return keys_[row] == gmap::kNoDart; }
  [[nodiscard]] DartId key(std::uint32_t row) const { return keys_[row]; }
  /// Rows of the orbits of a role, one per match.
  [[nodiscard]] const std::vector<Row>& rows(std::uint32_t role) const { return rows_[role]; }
  /// The matches' own numbers from `offset` on, that of match m at begin[stride * m].
  struct OwnColumn {
    const double* begin = nullptr;
    std::uint32_t stride = 0;
  };
  [[nodiscard]] OwnColumn own(std::uint32_t offset) const;
  [[nodiscard]] std::span<const DartId> nodes(std::uint32_t row) const {
    return {nodes_.data() + std::size_t{row} * widths_.nodes, widths_.nodes};
  }
  [[nodiscard]] std::span<const DartId> targets(std::uint32_t row) const {
    return {targets_.data() + std::size_t{row} * widths_.targets, widths_.targets};
  }
  /// MatchRoles::way of a match.
  [[nodiscard]] std::uint8_t way(std::uint32_t row) const { return ways_[row]; }
  [[nodiscard]] std::uint32_t role_count() const { return widths_.roles; }
  /// Bytes that the table holds for one match.
  [[nodiscard]] std::size_t bytes_per_match() const;

  /// Appends a match and returns its row.
  std::uint32_t add(const ForceMatch& match);
  /// The same from its columns alone.
  std::uint32_t add(DartId key, std::span<const Row> rows, std::span<const double> own);
  /// A match reads another orbit, or knows other numbers, than before.
  void set_row(std::uint32_t row, std::uint32_t role, Row orbit) { rows_[role][row] = orbit; }
  void set_own(std::uint32_t row, std::span<const double> own);
  /// Takes a match out; its row keeps what stands in it.
  void vacate(std::uint32_t row);
  /// Keeps these rows, in this order: row k becomes what `rows[k]` was.
  void pack(std::span<const std::uint32_t> rows);
  void clear();
  /// What a report needs of a match; the roles hold rows only.
  [[nodiscard]] ForceMatch match(std::uint32_t row, std::uint32_t shape) const;

 private:
  void add_own(std::span<const double> numbers);

  Widths widths_;
  std::uint32_t vacant_ = 0;
  std::vector<DartId> keys_;             // kNoDart: vacant
  std::vector<std::uint8_t> ways_;
  std::vector<std::vector<Row>> rows_;     // by role
  std::vector<std::vector<double>> own_;   // by value, all its doubles match by match
  std::vector<DartId> nodes_, targets_;    // by match
};

}  // namespace gmsim::engine
