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
/// the row of its smallest dart that had one, unless a part with a smaller dart keeps that row.
struct OrbitChange {
  Row row = kNoRow;
  DartId smallest = kNoDart;     ///< smallest dart of the orbit now
  std::uint32_t sources_begin = 0;  ///< slice of OrbitRepair::sources: the rows before the change
  std::uint32_t sources_count = 0;  ///< that its kept darts had; 0 for a created orbit
};

/// What repairs did, and their work space: one object used again and again allocates nothing.
struct OrbitRepair {
  std::vector<OrbitChange> orbits;  ///< every orbit that holds a touched dart, ascending `smallest`
  std::vector<Row> sources;         ///< ascending within an orbit
  std::vector<Row> removed;         ///< rows whose orbit is gone (all darts removed, or merged away)
  std::uint32_t created = 0;  ///< orbits of new darts only
  std::uint32_t split = 0;    ///< orbits that had to leave their row to another part of it
  std::uint32_t merged = 0;   ///< orbits with several sources
  std::uint64_t visited_darts = 0;  ///< work done, for `--profile`
  void clear();

  /// The rows before the change that an orbit's darts had.
  [[nodiscard]] std::span<const Row> sources_of(const OrbitChange& orbit) const {
    return {sources.data() + orbit.sources_begin, orbit.sources_count};
  }

 private:
  friend class OrbitIndex;
  /// An orbit that was walked and has no row yet; its darts are a slice of `darts_`.
  struct Part {
    DartId smallest;
    Row row_of_smallest;  // before the change
    std::uint32_t darts_begin, sources_begin, sources_end;
  };
  std::vector<Part> parts_;
  std::vector<DartId> darts_;
  std::vector<Row> open_;             // rows that no orbit has claimed yet
  std::vector<std::uint32_t> order_;  // smallest darts of the parts
  std::vector<std::uint64_t> bits_;
};

/// dart -> orbit row for one orbit type, kept only for the types in use and repaired locally.
class OrbitIndex {
 public:
  OrbitIndex(const GMap& map, OrbitType type);  ///< numbers orbits by ascending smallest dart

  [[nodiscard]] OrbitType type() const { return type_; }
  /// kNoRow for a dead dart.
  [[nodiscard]] Row row(DartId d) const { return rows_[index(d)]; }
  [[nodiscard]] std::span<const Row> rows() const { return rows_; }
  /// One past the largest row ever used; rows of dead orbits stay unused.
  [[nodiscard]] Row row_end() const { return static_cast<Row>(smallest_.size()); }
  [[nodiscard]] Row orbit_count() const { return alive_; }
  [[nodiscard]] bool alive(Row row) const { return smallest_[row] != kNoDart; }
  /// Smallest dart of the orbit.
  [[nodiscard]] DartId smallest(Row row) const { return smallest_[row]; }

  /// Re-partitions the orbits that hold a touched dart. `touched` must name every dart that was
  /// created or removed or whose links of this type changed since the last repair, in any order and
  /// any number of times; more is harmless. (Removed darts are dead in the map but still have their
  /// old row here.) Cost: the darts of those orbits, after the change, and the removed ones, so many
  /// rewrites may be followed by one repair. Adds to `repair` what happened, which does not depend
  /// on the order of `touched`. An index whose type has none of the changed links needs no repair
  /// unless darts were created or removed.
  void repair(const GMap& map, std::span<const DartId> touched, OrbitRepair& repair,
              Journal* journal = nullptr);
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  friend class Journal;
  void drop_dart(DartId d, OrbitRepair& work, Journal* journal);
  void open_row(Row row, std::uint32_t part, OrbitRepair& work, Journal* journal);
  void walk_part(const GMap& map, DartId d, OrbitRepair& work, Journal* journal);
  void sort_parts(OrbitRepair& work) const;
  Row claim_row(const OrbitRepair::Part& part);
  void name_parts(OrbitRepair& work);
  void close_rows(OrbitRepair& work);

  OrbitType type_;
  Row alive_ = 0;
  std::vector<Row> rows_;         // per dart
  std::vector<DartId> smallest_;  // per row; kNoDart: no such orbit any more
};

}  // namespace gmsim::gmap
