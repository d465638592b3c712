// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
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
  DartId smallest = kNoDart;        ///< smallest dart of the orbit now
  std::uint32_t sources_begin = 0;  ///< slice of OrbitRepair::sources: the rows before the change
  std::uint32_t sources_count = 0;  ///< that its kept darts had; 0 for a created orbit
};

/// Work space of repairs.
class RepairSpace {
  friend class OrbitRepairer;
  /// A walked orbit that has no row yet.
  struct Part {
    DartId smallest = kNoDart;
    std::uint32_t darts_begin = 0, darts_end = 0;  // slice of `darts_` and `old_rows_`
  };
  std::vector<Part> parts_;
  std::vector<DartId> darts_;    // never shrinks
  std::vector<DartId> queue_;
  std::vector<Row> old_rows_;    // as long as `darts_`
  std::vector<Row> open_, new_rows_;
};

/// What repairs did, and their work space: one object used again and again allocates nothing.
struct OrbitRepair {
  std::vector<OrbitChange> orbits;  ///< every orbit that holds a touched dart, ascending `smallest`
  std::vector<Row> sources;         ///< ascending within an orbit
  std::vector<Row> removed;   ///< rows whose orbit is gone (all darts removed, or merged away)
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
  RepairSpace space_;
};

/// Whole orbits that a caller knows: one after the other in `darts`, each up to one of `ends`.
struct KnownOrbits {
  std::span<const DartId> darts;
  std::span<const std::uint32_t> ends;
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
  /// old row here.) Cost: the darts of those orbits, after the change, and the removed ones, so
  /// many rewrites may be followed by one repair. Adds to `repair` what happened, which depends on
  /// the order of `touched` only in the order of `removed`. An index whose type has none of the
  /// changed links needs no repair unless darts were created or removed.
  void repair(const GMap& map, std::span<const DartId> touched, OrbitRepair& repair,
              Journal* journal = nullptr) {
    this->repair(map, touched, {}, repair, repair.space_, journal);
  }
  /// The same; orbits that are known as they are now need not be walked, nor be among the touched.
  void repair(const GMap& map, std::span<const DartId> touched, const KnownOrbits& known,
              OrbitRepair& repair, RepairSpace& space, Journal* journal = nullptr);

  // For rewrites that know what becomes of an orbit, in place of a repair.

  /// Gives a new row to darts that are a whole orbit now: new ones, or a part of an orbit whose
  /// smallest dart is not among them.
  Row add_orbit(std::span<const DartId> darts, Journal* journal = nullptr);
  /// Gives a new dart the row of the orbit it has joined.
  void add_dart(DartId d, Row row, Journal* journal = nullptr);
  /// After two darts were linked to each other and nothing was unlinked: makes their orbits one,
  /// with the row of its smallest dart. Returns the row that is gone; kNoRow when it was one orbit
  /// before. Cost: the darts of the row that is gone, so many merges of large orbits are better
  /// left to a repair.
  Row merge(const GMap& map, DartId a, DartId b, Journal* journal = nullptr) {
    return row(a) == row(b) ? kNoRow : merge_rows(map, a, b, journal);
  }
  /// Makes room for the darts that were created, before the two above.
  void grow(const GMap& map, Journal* journal = nullptr);
  /// Storage for as many darts and orbits.
  void reserve(std::uint32_t darts, Row orbits);
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  friend class Journal;
  friend class OrbitRepairer;
  void record_row(DartId d, Journal& journal);
  Row merge_rows(const GMap& map, DartId a, DartId b, Journal* journal);
  void rename(const GMap& map, DartId d, Row from, Row to, Journal* journal);

  OrbitType type_;
  bool two_links_ = false;
  int first_link_ = 0, second_link_ = 0;  // when it has two
  Row alive_ = 0;
  std::vector<Row> rows_;         // per dart
  std::vector<DartId> smallest_;  // per row; kNoDart: no such orbit any more
};

inline Row OrbitIndex::add_orbit(std::span<const DartId> darts, Journal* journal) {
  const Row row = row_end();
  DartId smallest = kNoDart;
  for (DartId d : darts) {
    smallest = std::min(smallest, d);
    add_dart(d, row, journal);
  }
  smallest_.push_back(smallest);
  ++alive_;
  return row;
}

inline void OrbitIndex::add_dart(DartId d, Row row, Journal* journal) {
  if (journal != nullptr) record_row(d, *journal);
  rows_[index(d)] = row;
}

}  // namespace gmsim::gmap
