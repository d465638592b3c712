// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "gmap/embedding_store.h"
#include "gmap/gmap.h"

namespace gmsim::gmap {

/// Records changes of a map, its orbit indices and its columns so that an operation can be all or
/// nothing. Cost: one record per changed entry, nothing when no journal is set.
class Journal {
 public:
  Journal();
  ~Journal();
  /// Undoes everything recorded, newest first; map and store are bitwise as before.
  void roll_back(GMap& map, EmbeddingStore& store);
  /// Forgets everything recorded: the changes stay.
  void commit();
  [[nodiscard]] std::size_t size() const;
  // … the record functions called by GMap, OrbitIndex and EmbeddingColumn are declared here too.
};

}  // namespace gmsim::gmap
