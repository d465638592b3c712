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
  [[nodiscard]] bool is_new(DartId d) const;

  // Called just before the change. `begin` notes the sizes, once.
  void begin(const GMap& map);
  void record(const GMap& map, int i, DartId d);
  void begin(OrbitIndex& index);
  void record_row(OrbitIndex& index, DartId d, Row old);
  void record_smallest(OrbitIndex& index, Row row, DartId old);
  void begin(EmbeddingColumn& column);
  void record(EmbeddingColumn& column, Row row);

 private:
  struct MapLog;
  struct IndexLog;
  struct ColumnLog;
  IndexLog& log(OrbitIndex& index);
  ColumnLog& log(EmbeddingColumn& column);

  std::vector<MapLog> map_;  // none or one
  std::vector<IndexLog> indices_;
  std::size_t last_index_ = 0;  // the one used last
  std::vector<ColumnLog> columns_;
};

}  // namespace gmsim::gmap
