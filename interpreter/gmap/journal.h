// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gmap/embedding_store.h"
#include "gmap/gmap.h"

namespace gmsim::gmap {

/// Records changes of a map, its orbit indices and its columns so that an operation can be all or
/// nothing. Cost: one record per changed entry, nothing when no journal is set. What is new since
/// the recording began (darts, rows) needs no record: undoing cuts it off.
///
/// A journal that is used again keeps its memory. A map records while `GMap::set_journal` is on; indices and columns when the journal is given to
/// the call that changes them. One journal serves one map and its store, which stay where they are
/// and gain no index or column while it holds records.
class Journal {
 public:
  Journal();
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Undoes everything recorded, newest first; map and store are bitwise as before. Columns that
  /// grew together with an index shrink with it.
  void roll_back(GMap& map, EmbeddingStore& store);
  /// Forgets everything recorded: the changes stay.
  void commit();
  /// Number of entries recorded.
  [[nodiscard]] std::size_t size() const;

  /// True for a dart that undoing cuts off.
  [[nodiscard]] bool is_new(DartId d) const {
    return map_.active && gmap::index(d) >= map_.dart_end;
  }

  /// The changes of one index.
  class IndexLog {
   public:
    explicit IndexLog(OrbitIndex& index) : index_(&index) {}
    void record_row(DartId d, Row old) {
      if (gmap::index(d) < dart_end_) rows_.push_back({d, old});
    }
    void record_smallest(Row row, DartId old) {
      if (row < row_end_) smallest_.push_back({row, old});
    }

   private:
    friend class Journal;
    struct RowOfDart {
      DartId dart;
      Row old;
    };
    struct SmallestOfRow {
      Row row;
      DartId old;
    };
    OrbitIndex* index_;
    bool active_ = false;
    std::size_t dart_end_ = 0;
    Row row_end_ = 0, alive_ = 0;
    std::vector<RowOfDart> rows_;
    std::vector<SmallestOfRow> smallest_;
  };

  // Called just before the change. `begin` and `log` note the sizes, once.
  void begin(const GMap& map);
  void record(const GMap& map, int i, DartId d) {
    if (!map_.active) begin(map);
    if (gmap::index(d) >= map_.dart_end) return;
    map_.links.push_back({d, map.alpha(i, d), static_cast<std::uint8_t>(i)});
  }
  /// Valid until the next one is asked for.
  IndexLog& log(OrbitIndex& index);
  void begin(EmbeddingColumn& column);
  void record(EmbeddingColumn& column, Row row);

 private:
  struct MapLog {
    struct Link {
      DartId dart;
      DartId old;
      std::uint8_t dimension;
    };
    bool active = false;
    std::uint32_t dart_end = 0, alive = 0;
    std::vector<Link> links = {};
  };
  struct ColumnLog;
  ColumnLog& log(EmbeddingColumn& column);

  MapLog map_;
  std::vector<IndexLog> indices_;
  std::size_t last_index_ = 0;  // the one used last
  std::vector<ColumnLog> columns_;
  std::size_t last_column_ = 0;
};

}  // namespace gmsim::gmap
