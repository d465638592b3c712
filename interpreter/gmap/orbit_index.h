// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gmap/gmap.h"

namespace gmsim::gmap {

/// Number of an orbit within an OrbitIndex: the row of its values in a column.
using Row = std::uint32_t;
inline constexpr Row kNoRow = 0xffffffffu;

/// How the orbits of one type changed. Rows live as long as their orbit: of the parts of a split,
/// the one with the smallest dart keeps the row and the others get new ones; a merged orbit keeps
/// the row of its smallest dart that had one.
struct OrbitChange {
  Row row = kNoRow;
  DartId smallest = kNoDart;     ///< smallest dart of the orbit now
  std::uint32_t sources_begin = 0;  ///< slice of OrbitRepair::sources: the rows before the change
  std::uint32_t sources_count = 0;  ///< that its kept darts had; 0 for a created orbit
};

struct OrbitRepair {
  std::vector<OrbitChange> orbits;  ///< every orbit that holds a touched dart, ascending `smallest`
  std::vector<Row> sources;
  std::vector<Row> removed;         ///< rows whose orbit is gone (all darts removed, or merged away)
  std::uint32_t created = 0, split = 0, merged = 0;  ///< event counts (theory 2.5)
  std::uint64_t visited_darts = 0;                   ///< work done, for `--profile`
  void clear();
};

/// dart -> orbit row for one orbit type, kept only for the types in use and repaired locally.
class OrbitIndex {
 public:
  OrbitIndex(const GMap& map, OrbitType type);  ///< numbers orbits by ascending smallest dart

  [[nodiscard]] OrbitType type() const { return type_; }
  [[nodiscard]] Row row(DartId d) const { return rows_[index(d)]; }
  [[nodiscard]] std::span<const Row> rows() const { return rows_; }
  /// One past the largest row ever used; rows of dead orbits stay unused.
  [[nodiscard]] Row row_end() const { return static_cast<Row>(smallest_.size()); }
  [[nodiscard]] Row orbit_count() const { return alive_; }
  [[nodiscard]] bool alive(Row row) const { return smallest_[row] != kNoDart; }
  /// Smallest dart of the orbit.
  [[nodiscard]] DartId smallest(Row row) const { return smallest_[row]; }

  /// Re-partitions the orbits that hold a touched dart (created darts included; removed darts are
  /// dead in the map but still have their old row here). Cost: the darts of those orbits, before
  /// and after. Adds to `repair` what happened.
  void repair(const GMap& map, std::span<const DartId> touched, OrbitRepair& repair,
              Journal* journal = nullptr);
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  friend class Journal;
  OrbitType type_;
  Row alive_ = 0;
  std::vector<Row> rows_;         // per dart
  std::vector<DartId> smallest_;  // per row; kNoDart: no such orbit any more
};

}  // namespace gmsim::gmap
